#include "tanglebin/model/axis/fragments/kinds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "tanglebin/base/median.hpp"
#include "tanglebin/model/axis/fragments/skeleton.hpp"
#include "tanglebin/model/axis/fragments/surface_radii.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3f;

/// The range of the tubes' radii.
struct Radii {
  double smallest;  // m
  double largest;   // m

  double middle() const { return std::sqrt(smallest * largest); }
};

Radii radii_of(const std::vector<TubeKind>& kinds) {
  const auto [smallest, largest] = std::ranges::minmax(kinds, {}, &TubeKind::radius);
  return {smallest.radius, largest.radius};
}

// The surface of a thin tube deviates from a plane by more than that of a thick one; its variance about the
// plane grows with the square of the deviation.
PatchSettings for_all(PatchSettings patch, const Radii& radii) {
  const double ratio = radii.largest / radii.smallest;
  patch.roughness_max *= ratio * ratio;
  return patch;
}

// Finds pieces of tubes of any kind. Votes with a wrong radius are spread out, but by less than the distance
// between tubes.
std::vector<std::vector<std::size_t>> pieces(const std::vector<Vector3f>& points, const KnownScene& known,
                                             const Radii& radii, VoteSettings vote,
                                             const FragmentSettings& fragment) {
  vote.patch = for_all(vote.patch, radii);
  vote.bin_tolerance = 1;  // a thinner tube's axis may be nearer to the bin than this radius
  vote.flat_min = std::numeric_limits<int>::max();  // beside this radius, a thick tube may look flat
  const double radius = radii.middle();
  const AxisVotes votes = vote_for_axes(points, known.support, known.camera, radius, vote);
  std::vector<std::vector<std::size_t>> found;
  for (Skeleton& skeleton : find_skeletons(votes.votes, fragment.voxel * radius, fragment.step * radius,
                                           std::numeric_limits<double>::infinity())) {
    found.push_back(std::move(skeleton.points));
  }
  return found;
}

std::size_t nearest_kind(const std::vector<TubeKind>& kinds, double radius) {
  const auto nearest = std::ranges::min_element(
      kinds, {}, [&](const TubeKind& kind) { return std::abs(std::log(kind.radius / radius)); });
  return static_cast<std::size_t>(nearest - kinds.begin());
}

// For each piece, the radii from its pairs of points.
std::vector<std::vector<float>> radii_of_pieces(const std::vector<std::vector<std::size_t>>& pieces,
                                                const std::vector<Vector3f>& points, const Camera& camera,
                                                const Radii& known) {
  constexpr auto no_piece = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> piece_of(points.size(), no_piece);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    for (const std::size_t point : pieces[i]) piece_of[point] = i;
  }
  std::vector<std::vector<float>> radii(pieces.size());
  const PixelGrid grid(points, camera);
  for (const PairRadius& pair : radii_of_pairs(grid, known.middle(), for_all(pair_patches, known))) {
    const std::size_t piece = piece_of[grid.indices()[pair.first]];
    if (piece != no_piece && piece == piece_of[grid.indices()[pair.second]])
      radii[piece].push_back(pair.radius);
  }
  return radii;
}

}  // namespace

std::vector<std::vector<Vector3f>> points_by_kind(std::vector<Vector3f> points, const KnownScene& known,
                                                  const VoteSettings& vote,
                                                  const FragmentSettings& fragment) {
  std::vector<std::vector<Vector3f>> result;
  if (known.kinds.size() == 1) {
    result.push_back(std::move(points));
    return result;
  }
  const Radii known_radii = radii_of(known.kinds);
  const std::vector<std::vector<std::size_t>> found = pieces(points, known, known_radii, vote, fragment);
  std::vector<std::vector<float>> radii = radii_of_pieces(found, points, known.camera, known_radii);

  const Vector3f nothing = Vector3f::Constant(std::numeric_limits<float>::quiet_NaN());
  result.assign(known.kinds.size(), std::vector(points.size(), nothing));
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (radii[i].empty()) continue;
    std::vector<Vector3f>& of_kind = result[nearest_kind(known.kinds, median(std::move(radii[i])))];
    for (const std::size_t point : found[i]) of_kind[point] = points[point];
  }
  return result;
}

}  // namespace tanglebin
