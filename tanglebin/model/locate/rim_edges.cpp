#include "tanglebin/model/locate/rim_edges.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace tanglebin {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using Eigen::Vector3f;

/// What a pixel shows.
enum class Shown : std::uint8_t {
  nothing,  ///< or something far below the rim's plane, or not near the rim
  rim,
  below,  ///< something just below the rim's plane, such as the side of a wall
  above,  ///< something above the rim's plane, which may hide more of the rim
};

/// Whether each pixel shows the rim.
class RimMap {
public:
  RimMap(const SensorView& view, const Bin& bin, const Isometry3d& from_camera, double closeness,
         double reach)
      : bin_(bin),
        closeness_(closeness),
        reach_(reach),
        width_(view.camera.width),
        height_(view.camera.height),
        shown_(view.points.size(), Shown::nothing) {
    const Eigen::Affine3f moved = from_camera.cast<float>();
    for (const std::size_t pixel : view.seen) {
      const Vector3f point = moved * view.points[pixel];
      shown_[pixel] = shown_at(point.cast<double>(), view.pixel_size(view.points[pixel].z()));
    }
  }

  Shown at(int column, int row) const {
    if (column < 0 || column >= width_ || row < 0 || row >= height_) return Shown::nothing;
    return shown_[static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
                  static_cast<std::size_t>(column)];
  }

  // The rim goes on to this pixel along (dx, dy) and ends there at a step down. Where it goes over into the
  // side of a wall, or something hides more of it, it is not clear where it ends.
  bool ends_at(int column, int row, int dx, int dy) const {
    return at(column, row) == Shown::rim && at(column - dx, row - dy) == Shown::rim &&
           at(column + dx, row + dy) == Shown::nothing && at(column + 2 * dx, row + 2 * dy) == Shown::nothing;
  }

private:
  Shown shown_at(const Vector3d& point, double pixel) const {
    constexpr double step = 4;  // pixels
    const double across_x = std::abs(point.x()) - bin_.length / 2;
    const double across_y = std::abs(point.y()) - bin_.width / 2;
    const double farthest = bin_.wall + reach_;
    if (across_x > farthest || across_y > farthest || (across_x < -reach_ && across_y < -reach_))
      return Shown::nothing;
    const double height = point.z() - bin_.height;
    if (height > closeness_) return Shown::above;
    if (height > -closeness_) return Shown::rim;
    return height > -closeness_ - step * pixel ? Shown::below : Shown::nothing;
  }

  Bin bin_;
  double closeness_;
  double reach_;
  int width_;
  int height_;
  std::vector<Shown> shown_;
};

}  // namespace

std::vector<RimEdge> rim_edges(const SensorView& view, const Bin& bin, const Isometry3d& pose,
                               double closeness, double reach) {
  const RimMap map(view, bin, pose.inverse(Eigen::Isometry), closeness, reach);
  const Vector3d up = pose.linear().col(2);
  const double offset = up.dot(pose * Vector3d(0, 0, bin.height));
  const auto on_rim = [&](int column, int row) {
    const Vector3d direction = ray_through(view.camera, column, row).direction;
    return Vector3d(offset / up.dot(direction) * direction);
  };
  constexpr std::array<std::array<int, 2>, 4> steps{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
  std::vector<RimEdge> edges;
  for (const std::size_t pixel : view.seen) {
    const int column = static_cast<int>(pixel % static_cast<std::size_t>(view.camera.width));
    const int row = static_cast<int>(pixel / static_cast<std::size_t>(view.camera.width));
    if (map.at(column, row) != Shown::rim) continue;
    for (const auto& [dx, dy] : steps) {
      if (!map.ends_at(column, row, dx, dy)) continue;
      const Vector3d point = on_rim(column, row);
      edges.push_back({point, point - on_rim(column - dx, row - dy)});
    }
  }
  return edges;
}

}  // namespace tanglebin
