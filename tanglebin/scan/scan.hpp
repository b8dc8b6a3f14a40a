#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "tanglebin/geometry/camera.hpp"
#include "tanglebin/geometry/labels.hpp"

namespace tanglebin {

/// Part of an image: columns [left, left + width), rows [top, top + height).
struct PixelWindow {
  int left = 0;
  int top = 0;
  int width = 0;
  int height = 0;
};

/// What the ray through one pixel met. All but `label` are NaN where it met nothing, or was not measured.
/// Depth, range and point are as measured; normal and incidence are the surface's true ones.
struct Pixel {
  float depth;             ///< m, along the camera's z axis
  float range;             ///< m, from the camera's centre to the point
  Eigen::Vector3f point;   ///< m, world frame
  Eigen::Vector3f normal;  ///< outward unit normal, world frame
  float incidence;         ///< rad, between the normal and the direction back to the camera
  std::int32_t label;
};

/// An organized scan: the pixels of `window`, row by row. The image's other pixels cannot see the scene; they
/// are as those whose ray met nothing.
struct Scan {
  Camera camera;
  PixelWindow window;
  std::vector<Pixel> pixels;  ///< window.width * window.height

  // Of a scan by a sensor; empty where the scanner is ideal
  std::vector<float> snr{};  ///< of each pixel: the signal-to-noise ratio (docs/sensor.md), which has no unit
  std::vector<std::uint8_t> mixed{};  ///< of each pixel: 1 where it is the mean of several surfaces

  /// The pixel in column u, row v of the whole image; (u, v) must lie in the window.
  const Pixel& at(int u, int v) const { return pixels[index(u, v)]; }
  Pixel& at(int u, int v) { return pixels[index(u, v)]; }

  /// Where the arrays have that pixel.
  std::size_t index(int u, int v) const {
    return static_cast<std::size_t>(v - window.top) * static_cast<std::size_t>(window.width) +
           static_cast<std::size_t>(u - window.left);
  }
};

/// The pixel of a ray that met nothing.
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
