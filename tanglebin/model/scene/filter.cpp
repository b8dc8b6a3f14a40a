#include "tanglebin/model/scene/filter.hpp"

#include <algorithm>
#include <cmath>

#include "tanglebin/base/random.hpp"

namespace tanglebin {
namespace {

/// The space within a margin of some boxes.
class NearBoxes {
public:
  NearBoxes(const std::vector<Eigen::AlignedBox3d>& boxes, double margin) : margin_(margin) {
    const Eigen::Vector3d grown = Eigen::Vector3d::Constant(margin);
    for (const Eigen::AlignedBox3d& box : boxes)
      boxes_.push_back({box, {box.min() - grown, box.max() + grown}});
  }

  bool contain(const Eigen::Vector3d& point) const {
    return std::ranges::any_of(boxes_, [&](const auto& box) {
      return box.grown.contains(point) && box.itself.squaredExteriorDistance(point) < margin_ * margin_;
    });
  }

private:
  struct Box {
    Eigen::AlignedBox3d itself;
    Eigen::AlignedBox3d grown;  // contains every point that is near enough, and is soon asked
  };

  double margin_;  // m
  std::vector<Box> boxes_;
};

}  // namespace

Eigen::AlignedBox3d crop_box(const Support& support, double overhang) {
  const Eigen::Vector3d far = Eigen::Vector3d::Constant(20);  // m; keeps the indices of grids in range
  if (support.shape == Support::Shape::nothing) return {-far, far};
  Eigen::AlignedBox3d box;
  for (const Eigen::AlignedBox3d& part : solid_parts(support)) box.extend(part);
  box.min().array() -= overhang;
  box.max().array() += overhang;
  if (support.shape == Support::Shape::plane) box.max().z() = far.z();
  return box.intersection({-far, far});
}

Cropped crop(const PointCloud& cloud, const Support& support, const FilterSettings& settings) {
  const std::vector<Eigen::AlignedBox3d> parts = solid_parts(support);
  const Eigen::AlignedBox3d around = crop_box(support, settings.overhang);
  const NearBoxes solid(parts, settings.margin);
  const NearBoxes in_doubt(parts, settings.margin + support.margin);
  Cropped cropped;
  for (auto* indices : {&cropped.kept, &cropped.support, &cropped.outside})
    indices->reserve(cloud.points.size());
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const Eigen::Vector3d point = cloud.points[i].cast<double>();
    if (!point.allFinite()) continue;
    if (!around.contains(point)) {
      cropped.outside.push_back(i);
    } else if (solid.contain(point)) {
      cropped.support.push_back(i);
    } else {
      cropped.kept.push_back(i);
      if (support.margin > 0 && in_doubt.contain(point)) cropped.near.push_back(i);
    }
  }
  return cropped;
}

// Algorithm S (Knuth, The Art of Computer Programming, volume 2, 3.4.2).
std::vector<std::size_t> downsample(const std::vector<std::size_t>& indices, double ratio,
                                    std::uint64_t seed) {
  const auto wanted = static_cast<std::size_t>(std::llround(ratio * static_cast<double>(indices.size())));
  if (wanted == indices.size()) return indices;
  Rng rng(seed);
  std::vector<std::size_t> drawn;
  drawn.reserve(wanted);
  for (std::size_t i = 0; i < indices.size() && drawn.size() < wanted; ++i) {
    const auto left = static_cast<double>(indices.size() - i);
    if (left * uniform_real(rng, 0, 1) < static_cast<double>(wanted - drawn.size())) {
      drawn.push_back(indices[i]);
    }
  }
  return drawn;
}

}  // namespace tanglebin
