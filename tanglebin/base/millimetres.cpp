#include "tanglebin/base/millimetres.hpp"

#include <fmt/format.h>

namespace tanglebin {

std::string hint_of_millimetres(double metres) {
  return metres < 1 ? "" : fmt::format("; for {0:.6g} mm write {1:.6g}", metres, metres / 1000);
}

}  // namespace tanglebin
