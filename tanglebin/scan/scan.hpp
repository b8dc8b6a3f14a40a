#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "tanglebin/geometry/camera.hpp"
#include "tanglebin/geometry/labels.hpp"

namespace tanglebin {

/// A part of an image: columns [left, left + width), rows [top, top + height).
struct PixelWindow {
  int left = 0;
  int top = 0;
  int width = 0;
  int height = 0;
};

/// What the ray through a pixel hit. If it hit nothing, or was not measured, everything but `label` is NaN.
/// Depth, range and point are as measured; normal and incidence are those of the true surface.
struct Pixel {
  float depth;             ///< m, along the camera's z axis
  float range;             ///< m, from the camera's centre to the point
  Eigen::Vector3f point;   ///< m, world frame
  Eigen::Vector3f normal;  ///< outward unit normal, world frame
  float incidence;         ///< rad, between the normal and the direction back to the camera
  std::int32_t label;
};

/// An organized scan: the pixels of `window`, row by row. The rest of the image cannot see the scene; its
/// pixels count as rays that hit nothing.
struct Scan {
  Camera camera;
  PixelWindow window;
  std::vector<Pixel> pixels;  ///< window.width * window.height

  // From a sensor; empty for an ideal scanner
  std::vector<float> snr{};           ///< signal-to-noise ratio of each pixel, unitless (docs/sensor.md)
  std::vector<std::uint8_t> mixed{};  ///< for each pixel: 1 if it is the mean of several surfaces

  /// The pixel in column u and row v of the whole image; (u, v) must lie in the window.
  const Pixel& at(int u, int v) const { return pixels[index(u, v)]; }
  Pixel& at(int u, int v) { return pixels[index(u, v)]; }

  /// Index of that pixel in the arrays.
  std::size_t index(int u, int v) const {
    return static_cast<std::size_t>(v - window.top) * static_cast<std::size_t>(window.width) +
           static_cast<std::size_t>(u - window.left);
  }
};

/// Whether a pixel of the scan is on a tube.
inline bool shows_a_tube(const Scan& scan) {
  return std::ranges::any_of(scan.pixels, [](const Pixel& pixel) { return pixel.label > bin_label; });
}

/// The pixel of a ray that hit nothing.
inline Pixel empty_pixel() {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  return {.depth = nan,
          .range = nan,
          .point = Eigen::Vector3f::Constant(nan),
          .normal = Eigen::Vector3f::Constant(nan),
          .incidence = nan,
          .label = null_label};
}

}  // namespace tanglebin
