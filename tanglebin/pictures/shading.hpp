#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/geometry/camera.hpp"

namespace tanglebin {

/// The nearest surface at one sample of a picture.
struct SurfaceSample {
  float depth = std::numeric_limits<float>::infinity();  ///< m, along the camera's z axis; ∞: background
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();      ///< unit, world frame, towards the camera
  Color color{};                                         ///< unshaded
  std::int32_t object = 0;                               ///< different objects are separated by a line
  int glass = 0;                                         ///< the transparent wall in front of it; 0: none
};

/// What is to be shaded: camera.width * camera.height samples, row by row.
struct SurfaceImage {
  Camera camera;
  std::vector<SurfaceSample> samples;

  explicit SurfaceImage(const Camera& camera_)
      : camera(camera_),
        samples(static_cast<std::size_t>(camera_.width) * static_cast<std::size_t>(camera_.height)) {}

  std::size_t index(int u, int v) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(camera.width) + static_cast<std::size_t>(u);
  }
  SurfaceSample& at(int u, int v) { return samples[index(u, v)]; }
  const SurfaceSample& at(int u, int v) const { return samples[index(u, v)]; }
};

/// A picture's pixels, row by row.
struct Picture {
  int width = 0;
  int height = 0;
  std::vector<Color> pixels;
};

inline constexpr Color background_color{250, 250, 250};

/// Samples per pixel of the picture, in each direction.
inline constexpr int supersampling = 2;

/// Lights the samples, separates near objects from those behind them, and averages the samples of each pixel.
Picture shade(const SurfaceImage& image);

}  // namespace tanglebin
