#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "tanglebin/geometry/bin.hpp"
#include "tanglebin/geometry/camera.hpp"
#include "tanglebin/geometry/intersect.hpp"
#include "tanglebin/geometry/tube.hpp"
#include "tanglebin/scan/capsule_index.hpp"
#include "tanglebin/scan/scan.hpp"

namespace tanglebin {

// Internal to the room: what the rays of a scene can hit, with a lookup for many rays at once.

/// The capsules of all tubes and the boxes of the bin, all bounded.
struct Surfaces {
  std::vector<Eigen::AlignedBox3d> boxes;
  std::vector<Capsule> capsules;
  std::vector<std::int32_t> labels;  ///< of the capsules
};

Surfaces surfaces_of(const std::vector<Tube>& tubes, std::vector<Eigen::AlignedBox3d> boxes);
Surfaces surfaces_of(const std::vector<Tube>& tubes, const Bin& bin);

/// The window of pixels onto which the scene projects, enlarged by `margin` pixels. The whole image if the
/// scene is only partly in front of the camera.
PixelWindow window_of(const Surfaces& surfaces, const Camera& camera, double margin);

/// A surface that the rays of a tile may hit. Lists of candidates are sorted by distance.
struct Candidate {
  std::size_t index;  ///< into the array of surfaces
  double nearest;     ///< m; no ray of the tile hits it nearer to its origin
};
struct Candidates {
  std::vector<Candidate> boxes;
  std::vector<Candidate> capsules;
};

struct LabelledHit {
  SurfaceHit surface;
  std::int32_t label;
};

/// The first surface that the ray hits. At equal distances, the bin comes before the tubes, and these in
/// their order.
std::optional<LabelledHit> first_hit(const Surfaces& surfaces, const Candidates& candidates, const Ray& ray);

/// True if the ray hits anything nearer than `distance`.
bool is_blocked(const Surfaces& surfaces, const Candidates& candidates, const Ray& ray, double distance);

/// Finds the candidates of square tiles of an image. The rays of a tile hit nearly the same surfaces, so the
/// lookup is done once for all of them.
class TileIndex {
public:
  /// For rays through image coordinates up to `margin` pixels outside a tile's outermost pixel centres.
  TileIndex(const Surfaces& surfaces, const Camera& camera, double margin);

  int tile_size() const { return tile_size_; }  ///< pixels

  /// For the tile whose first pixel is in column `left` and row `top`.
  void find(int left, int top, Candidates& found) const;

private:
  const Camera& camera_;
  int tile_size_;
  BeamShape beam_;  ///< of a tile's rays
  CapsuleIndex capsule_index_;
  std::vector<Capsule> thick_capsules_;  ///< thickened for the beam, as are the boxes
  std::vector<Eigen::AlignedBox3d> thick_boxes_;
};

}  // namespace tanglebin
