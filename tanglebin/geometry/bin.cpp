#include "tanglebin/geometry/bin.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/millimetres.hpp"
#include "tanglebin/base/suggestion.hpp"

namespace tanglebin {
namespace {

void validate_positive(const char* field, double value) {
  if (!std::isfinite(value) || value <= 0)
    throw InputError({.file = "", .line = 0, .field = field}, fmt::format("{}", value),
                     "a finite positive number");
}

void validate_size(const char* field, double metres, double least) {
  constexpr double most = 10;
  validate_positive(field, metres);
  if (metres < least || metres > most)
    throw InputError({.file = "", .line = 0, .field = field}, fmt::format("{} m", metres),
                     fmt::format("{} to {} m{}", least, most, hint_of_millimetres(metres, most)));
}

}  // namespace

Bin bin_preset(std::string_view name) {
  if (name == "paper") return Bin{};
  if (name == "published") return Bin{.length = 0.80, .width = 0.60};
  reject_name(name, {"paper", "published"});
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

bool is_over_floor(const Bin& bin, const Eigen::Vector3d& point, double border) {
  return std::abs(point.x()) < bin.length / 2 - border && std::abs(point.y()) < bin.width / 2 - border;
}

void validate(const Bin& bin) {
  constexpr double narrowest = 0.02;
  validate_size("bin.length", bin.length, narrowest);
  validate_size("bin.width", bin.width, narrowest);
  validate_size("bin.height", bin.height, 0);
  validate_size("bin.wall", bin.wall, 0);
  validate_positive("bin.friction", bin.friction);
}

}  // namespace tanglebin
