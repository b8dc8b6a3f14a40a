#include "tanglebin/model/axis/radius.hpp"

#include <utility>
#include <vector>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/median.hpp"
#include "tanglebin/base/picked.hpp"
#include "tanglebin/model/axis/surface_radii.hpp"
#include "tanglebin/model/scene/filter.hpp"

namespace tanglebin {

double estimate_radius(const PointCloud& cloud, const KnownScene& known) {
  const PixelGrid grid(picked(cloud.points, crop(cloud, known.support, {}).kept), known.camera);
  // Pairs at the right distance need the radius, so start from a likely one.
  auto radius = static_cast<float>(TubeKind().radius);
  constexpr int refinements = 6;
  constexpr std::size_t pairs_min = 100;
  for (int i = 0; i < refinements; ++i) {
    std::vector<float> radii;
    for (const PairRadius& pair : radii_of_pairs(grid, radius)) radii.push_back(pair.radius);
    if (radii.size() < pairs_min) {
      throw InputError({"", 0, "radius"},
                       "the cloud shows too little of a tube to estimate it; give the radius");
    }
    radius = median(std::move(radii));
  }
  return radius;
}

}  // namespace tanglebin
