#include "tanglebin/geometry/bin.hpp"

#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/text.hpp"

namespace tanglebin {

Bin bin_preset(std::string_view name) {
  if (name == "paper") return Bin{};
  if (name == "published") return Bin{.length = 0.80, .width = 0.60};
  throw InputError({.file = "", .line = 0, .field = "bin"}, excerpt(name), "paper or published");
}

std::array<Eigen::AlignedBox3d, 5> boxes(const Bin& bin) {
  using Box = Eigen::AlignedBox3d;
  using Eigen::Vector3d;
  const double x = bin.length / 2;
  const double y = bin.width / 2;
  const double x_out = x + bin.wall;
  const double y_out = y + bin.wall;
  // The floor extends under the walls; the walls across x cover the ends of those across y.
  return {Box(Vector3d(-x_out, -y_out, -bin.wall), Vector3d(x_out, y_out, 0)),
          Box(Vector3d(-x_out, -y_out, 0), Vector3d(-x, y_out, bin.height)),
          Box(Vector3d(x, -y_out, 0), Vector3d(x_out, y_out, bin.height)),
          Box(Vector3d(-x, -y_out, 0), Vector3d(x, -y, bin.height)),
          Box(Vector3d(-x, y, 0), Vector3d(x, y_out, bin.height))};
}

void validate(const Bin& bin) {
  const std::array<std::pair<const char*, double>, 5> fields{{{"bin.length", bin.length},
                                                              {"bin.width", bin.width},
                                                              {"bin.height", bin.height},
                                                              {"bin.wall", bin.wall},
                                                              {"bin.friction", bin.friction}}};
  for (const auto& [name, value] : fields) {
    if (!std::isfinite(value) || value <= 0) {
      throw InputError({.file = "", .line = 0, .field = name}, std::to_string(value),
                       "a finite positive number");
    }
  }
}

}  // namespace tanglebin
