#include "tanglebin/scan/tile_index.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "tests/scan/scene.hpp"

namespace tanglebin {
namespace {

// What a ray meets is a candidate, and not met before it may be.
void expect_candidate(const std::vector<Candidate>& candidates, std::size_t index,
                      const std::optional<SurfaceHit>& hit) {
  if (!hit) return;
  const auto found = std::ranges::find(candidates, index, &Candidate::index);
  ASSERT_NE(found, candidates.end()) << index;
  EXPECT_GE(hit->distance, found->nearest) << index;
}

TEST(TileIndex, NoRayOfATileMeetsMoreThanTheCandidatesNorNearer) {
  constexpr double margin = 3;
  constexpr int rays = 4000;
  Rng rng(11);
  const Bin bin;
  const Surfaces surfaces = surfaces_of(test::random_pile(rng, 20, bin), bin);
  const Camera camera = downward_camera(960, 600, 700, {0.1, 0, 1});
  const TileIndex index(surfaces, camera, margin);
  Candidates candidates;
  for (int i = 0; i < rays; ++i) {
    const double left = std::floor(uniform_real(rng, 200, 700));
    const double top = std::floor(uniform_real(rng, 100, 450));
    index.find(static_cast<int>(left), static_cast<int>(top), candidates);
    EXPECT_TRUE(std::ranges::is_sorted(candidates.capsules, {}, &Candidate::nearest));
    EXPECT_TRUE(std::ranges::is_sorted(candidates.boxes, {}, &Candidate::nearest));
    const double reach = index.tile_size() - 1 + margin;
    const Ray ray = ray_through(camera, left + uniform_real(rng, -margin, reach),
                                top + uniform_real(rng, -margin, reach));
    for (std::size_t k = 0; k < surfaces.capsules.size(); ++k) {
      expect_candidate(candidates.capsules, k, ray_capsule(ray, surfaces.capsules[k]));
    }
    for (std::size_t k = 0; k < surfaces.boxes.size(); ++k) {
      expect_candidate(candidates.boxes, k, ray_box(ray, surfaces.boxes[k]));
    }
  }
}

}  // namespace
}  // namespace tanglebin
