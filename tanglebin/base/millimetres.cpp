#include "tanglebin/base/millimetres.hpp"

#include <fmt/format.h>

namespace tanglebin {

std::string hint_of_millimetres(double metres, double most) {
  const double meant = metres / 1000;
  return metres < 1 || meant > most ? "" : fmt::format("; for {:.6g} mm write {:.6g}", metres, meant);
}

}  // namespace tanglebin
