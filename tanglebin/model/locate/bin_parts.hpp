#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "tanglebin/geometry/bin.hpp"
#include "tanglebin/geometry/ray.hpp"
#include "tanglebin/model/locate/sensor_view.hpp"

// Internal to the room. The surfaces of a bin, in its frame.
namespace tanglebin {

/// What a plane surface of the bin belongs to.
enum class PartKind { floor, rim, inner, outer };

/// The surfaces: the floor, then for each of the walls at −x, +x, −y, +y its rim, inner and outer side.
inline constexpr std::size_t part_count = 13;

/// The index of a wall's surface. Walls are 0 to 3: −x, +x, −y, +y.
std::size_t part_of(PartKind kind, std::size_t wall);
PartKind kind_of_part(std::size_t part);
std::size_t wall_of_part(std::size_t part);

/// "the wall at +x".
std::string name_of_wall(std::size_t wall);

/// +1 for a wall on the positive side of its axis, −1 for one on the negative side; the axis: 0 for x, 1 for
/// y.
double side_of_wall(std::size_t wall);
int axis_of_wall(std::size_t wall);

/// A surface of the bin: normal · point = offset, m.
struct PartPlane {
  Eigen::Vector3d normal;  ///< outward
  double offset;
};
PartPlane plane_of_part(const Bin& bin, std::size_t part);

/// Whether two poses of a bin are those of two bins side by side: where a bin stands, another cannot.
bool are_beside(const Bin& bin, const Eigen::Isometry3d& first, const Eigen::Isometry3d& second);

/// Where a ray first meets a bin.
struct PartHit {
  std::size_t part;
  double distance;  ///< m, from the ray's origin
  double cosine;    ///< of the angle of incidence
};
std::optional<PartHit> first_hit(const std::array<Eigen::AlignedBox3d, 5>& boxes, const Bin& bin,
                                 const Ray& ray);

/// What a pixel says of a bin.
enum class Verdict {
  none,          ///< its ray misses the bin, or nothing was measured
  explained,     ///< the surface of the bin is measured there
  hidden,        ///< something nearer is
  contradicted,  ///< something farther is, which the bin would hide
};

/// The part that a pixel should show, if any, and what it says.
struct PixelVerdict {
  std::optional<std::size_t> part;
  Verdict verdict;
};

/// Of pixels: `pose` takes the bin's frame to the camera's. Closeness is across the surface, m.
std::vector<PixelVerdict> verdicts(const SensorView& view, const std::vector<std::size_t>& pixels,
                                   const Bin& bin, const Eigen::Isometry3d& pose, double closeness);

/// How many pixels say what, by the part that each should show; `expected` are all of a part.
struct Agreement {
  std::array<int, part_count> expected{};
  std::array<int, part_count> explained{};
  std::array<int, part_count> hidden{};
  std::array<int, part_count> contradicted{};
};
Agreement agreement_of(const std::vector<PixelVerdict>& verdicts);

/// 1 for a pixel that is explained, −2 for one that contradicts, else 0. score_of() is the sum.
int value_of(Verdict verdict);
int score_of(const std::vector<PixelVerdict>& verdicts);

}  // namespace tanglebin
