#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tanglebin/geometry/bin.hpp"
#include "tanglebin/geometry/camera.hpp"
#include "tanglebin/geometry/tube.hpp"

namespace tanglebin {

/// A tube as a camera would see it if nothing else were there: its whole ("amodal") mask. Geometry alone, as
/// the ideal scanner sees it: a pixel belongs to it if the ray through its centre meets the tube.
struct WholeView {
  int tube;                           ///< its id
  std::vector<std::uint32_t> pixels;  ///< row * width + column, ascending
  std::vector<float> ranges;          ///< m, from the camera to the tube's surface, of each
};

/// The tubes' whole views, in their order. Throws InputError as validate(camera) does.
std::vector<WholeView> whole_views(const std::vector<Tube>& tubes, const Camera& camera);

/// How much of a tube the others and the bin leave visible.
struct TubeVisibility {
  int tube;             ///< its id
  std::size_t whole;    ///< pixels that would show it if nothing else were there
  std::size_t visible;  ///< of these, pixels that do show it

  /// visible / whole; 0 if the tube is not in the image.
  double share() const { return whole == 0 ? 0 : static_cast<double>(visible) / static_cast<double>(whole); }
};

/// A connected region of the image (a pixel has eight neighbours) in which one tube, or the bin, lies over
/// another tube as seen from the camera: nearer to it.
struct Crossing {
  int over;               ///< a tube's id, or bin_label
  int under;              ///< a tube's id
  std::size_t pixels;     ///< in the region
  std::size_t visible;    ///< of these, pixels that show what lies over; others may lie over both
  Eigen::Vector2d pixel;  ///< the region's centroid, column and row
  Eigen::Vector3d point;  ///< m, world frame: mean of the points on the surface of what lies over
};

/// Which tube hides which, as seen from a camera.
struct Occlusions {
  std::vector<TubeVisibility> tubes;  ///< in the tubes' order
  std::vector<Crossing> crossings;    ///< in order of the two's places (the bin first), who is over, and row
};

/// The occlusions of tubes, in ascending order of their ids, in a bin. `views` are their whole_views().
/// Throws InputError as validate(camera) does.
Occlusions occlusions(const std::vector<Tube>& tubes, const std::vector<WholeView>& views, const Bin& bin,
                      const Camera& camera);

}  // namespace tanglebin
