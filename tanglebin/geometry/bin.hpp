#pragma once

#include <Eigen/Geometry>
#include <array>
#include <string_view>

namespace tanglebin {

/// An open box. World frame: z up, origin on the centre of the floor's upper side, x along the length.
struct Bin {
  double length = 0.55;   ///< m, inner size along x
  double width = 0.37;    ///< m, inner size along y
  double height = 0.20;   ///< m, from the floor's upper side to the rim
  double wall = 0.02;     ///< m, thickness of walls and floor
  double friction = 100;  ///< Coulomb coefficient of a tube against the bin

  bool operator==(const Bin&) const = default;
};

/// "paper" (0.55 x 0.37 x 0.20 m, Section 6.1) or "published" (0.80 x 0.60 x 0.20 m, as in the published
/// worlds). Throws InputError for any other name.
Bin bin_preset(std::string_view name);

/// The floor, then the walls at −x, +x, −y, +y. They touch without overlapping; together they form the bin.
std::array<Eigen::AlignedBox3d, 5> boxes(const Bin& bin);

/// Whether a point, m, is between the walls at any height, by more than `border` (m) inside them. A negative
/// border reaches beyond them.
bool is_over_floor(const Bin& bin, const Eigen::Vector3d& point, double border = 0);

/// Throws InputError naming the field under `bin` unless every number is finite and positive, length and
/// width are at least 0.02 m, and no size is above 10 m.
void validate(const Bin& bin);

}  // namespace tanglebin
