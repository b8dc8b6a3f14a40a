#pragma once

#include <Eigen/Geometry>
#include <array>
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

// Internal to the room: what a scene's rays can meet, and how to look it up for many rays at once.

/// The capsules of all tubes and the boxes of the bin.
struct Surfaces {
  std::array<Eigen::AlignedBox3d, 5> boxes;
  std::vector<Capsule> capsules;
  std::vector<std::int32_t> labels;  ///< of the capsules
};

Surfaces surfaces_of(const std::vector<Tube>& tubes, const Bin& bin);

/// The pixels onto which the scene projects and those up to `margin` pixels beside them; all of them where
/// the scene is only partly in front of the camera.
PixelWindow window_of(const Surfaces& surfaces, const Camera& camera, double margin);

/// What the rays of a tile may meet, nearest first.
struct Candidate {
  std::size_t index;  ///< in the surfaces' array
  double nearest;     ///< m: no ray of the tile meets it nearer to its origin
};
struct Candidates {
  std::vector<Candidate> boxes;
  std::vector<Candidate> capsules;
};

struct LabelledHit {
  SurfaceHit surface;
  std::int32_t label;
};

/// What the ray meets first. Of surfaces at the same distance: the bin, then the tubes in their order.
std::optional<LabelledHit> first_hit(const Surfaces& surfaces, const Candidates& candidates, const Ray& ray);

/// Does the ray meet anything closer than `distance`?
bool is_blocked(const Surfaces& surfaces, const Candidates& candidates, const Ray& ray, double distance);

/// Finds the candidates of square tiles of an image. The rays of a tile meet nearly the same things, so what
/// they may meet is looked up once for all of them.
class TileIndex {
public:
  /// For rays through image coordinates up to `margin` pixels outside of a tile's outermost pixel centres.
  TileIndex(const Surfaces& surfaces, const Camera& camera, double margin);

  int tile_size() const { return tile_size_; }  ///< pixels

  /// Of the tile whose first pixel is in column `left` and row `top`.
  void find(int left, int top, Candidates& found) const;

private:
  const Camera& camera_;
  int tile_size_;
  BeamShape beam_;  ///< of a tile's rays
  CapsuleIndex capsule_index_;
  std::vector<Capsule> thick_capsules_;  ///< as thick as the beam needs, and so the boxes
  std::array<Eigen::AlignedBox3d, 5> thick_boxes_;
};

}  // namespace tanglebin
