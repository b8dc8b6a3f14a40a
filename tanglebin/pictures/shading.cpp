#include "tanglebin/pictures/shading.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tanglebin {
namespace {

using Eigen::Vector3f;

Vector3f to_vector(const Color& color) {
  return {static_cast<float>(color[0]), static_cast<float>(color[1]), static_cast<float>(color[2])};
}

Color to_color(const Vector3f& color) {
  const auto channel = [](float value) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0F, 255.0F)));
  };
  return {channel(color.x()), channel(color.y()), channel(color.z())};
}

bool is_background(const SurfaceSample& sample) {
  return !std::isfinite(sample.depth);
}

// ---- Light
// -------------------------------------------------------------------------------------------------

/// A key light over the viewer's left shoulder, a headlight, and ambient light. They move with the viewer, so
/// no side of a scene is dark.
class Lights {
public:
  explicit Lights(const Camera& camera)
      : to_viewer_(-camera.pose.linear().col(2).cast<float>()),
        to_key_(camera.pose.linear().cast<float>() * Vector3f(-0.45F, -0.75F, -0.6F).normalized()),
        halfway_((to_viewer_ + to_key_).normalized()) {}

  Vector3f shine_on(const SurfaceSample& sample) const {
    constexpr float ambient = 0.42F;
    constexpr float key = 0.38F;
    constexpr float headlight = 0.28F;
    constexpr float highlight = 0.12F;
    const float diffuse = ambient + key * std::max(0.0F, sample.normal.dot(to_key_)) +
                          headlight * std::max(0.0F, sample.normal.dot(to_viewer_));
    // Blinn-Phong, with the exponent of matt plastic.
    const float specular = highlight * std::pow(std::max(0.0F, sample.normal.dot(halfway_)), 40.0F);
    return diffuse * to_vector(sample.color) + Vector3f::Constant(255.0F * specular);
  }

private:
  Vector3f to_viewer_;
  Vector3f to_key_;
  Vector3f halfway_;
};

// ---- Depth
// -------------------------------------------------------------------------------------------------

struct DepthSum {
  float depth = 0;
  float samples = 0;
};

/// Replaces `count` values `stride` apart by the sums over 2 * radius + 1 neighbours.
void sum_neighbours(DepthSum* values, int count, std::ptrdiff_t stride, int radius,
                    std::vector<DepthSum>& line) {
  line.resize(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < line.size(); ++i) line[i] = values[static_cast<std::ptrdiff_t>(i) * stride];
  // In double precision, because the sum runs along the whole line.
  double depth = 0;
  double samples = 0;
  const auto add = [&](int i, double sign) {
    if (i < 0 || i >= count) return;
    depth += sign * static_cast<double>(line[static_cast<std::size_t>(i)].depth);
    samples += sign * static_cast<double>(line[static_cast<std::size_t>(i)].samples);
  };
  const double average = 1.0 / (2 * radius + 1);
  for (int i = 0; i < radius; ++i) add(i, 1);
  for (int i = 0; i < count; ++i) {
    add(i + radius, 1);
    add(i - radius - 1, -1);
    values[i * stride] = {static_cast<float>(depth * average), static_cast<float>(samples * average)};
  }
}

/// The mean depth around each sample, by three box filters, which approximate a Gaussian. Ignores the
/// background.
std::vector<DepthSum> blurred_depth(const SurfaceImage& image, int radius) {
  std::vector<DepthSum> sums;
  sums.reserve(image.samples.size());
  for (const SurfaceSample& sample : image.samples) {
    sums.push_back(is_background(sample) ? DepthSum{} : DepthSum{sample.depth, 1});
  }
  std::vector<DepthSum> line;
  const auto [width, height] = std::pair(image.camera.width, image.camera.height);
  for (int pass = 0; pass < 3; ++pass) {
    for (int v = 0; v < height; ++v) sum_neighbours(&sums[image.index(0, v)], width, 1, radius, line);
    for (int u = 0; u < width; ++u) sum_neighbours(&sums[image.index(u, 0)], height, width, radius, line);
  }
  return sums;
}

/// The light that remains at each sample with nearer things around it (Luft, Colditz, Deussen 2006, "Image
/// enhancement by unsharp masking the depth buffer"). Like a contact shadow, it separates crossing tubes of
/// the same colour.
std::vector<float> light_left(const SurfaceImage& image) {
  constexpr double deepest = 0.025;  // of the depth; samples this far behind are darkest
  constexpr float darkest = 0.5F;
  const int radius = std::max(1, std::max(image.camera.width, image.camera.height) / 150);
  const std::vector<DepthSum> blurred = blurred_depth(image, radius);
  std::vector<float> light(image.samples.size(), 1.0F);
  for (std::size_t i = 0; i < light.size(); ++i) {
    const SurfaceSample& sample = image.samples[i];
    if (is_background(sample)) continue;
    const float behind = sample.depth - blurred[i].depth / blurred[i].samples;
    const float share = std::clamp(behind / (static_cast<float>(deepest) * sample.depth), 0.0F, 1.0F);
    light[i] = 1 - (1 - darkest) * share;
  }
  return light;
}

/// True if holds(sample, neighbour) for one of the four adjacent samples.
template <class Relation>
bool any_neighbour(const SurfaceImage& image, int u, int v, Relation holds) {
  const SurfaceSample& sample = image.at(u, v);
  return (u > 0 && holds(sample, image.at(u - 1, v))) || (v > 0 && holds(sample, image.at(u, v - 1))) ||
         (u + 1 < image.camera.width && holds(sample, image.at(u + 1, v))) ||
         (v + 1 < image.camera.height && holds(sample, image.at(u, v + 1)));
}

bool is_beside_nearer_object(const SurfaceSample& sample, const SurfaceSample& neighbour) {
  return neighbour.object != sample.object && neighbour.depth < sample.depth;
}

bool is_edge_of_glass(const SurfaceSample& sample, const SurfaceSample& neighbour) {
  return neighbour.glass < sample.glass;
}

Picture average(const SurfaceImage& image, const std::vector<Vector3f>& colors) {
  Picture picture{image.camera.width / supersampling, image.camera.height / supersampling, {}};
  constexpr int samples = supersampling * supersampling;
  picture.pixels.reserve(colors.size() / samples);
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      Vector3f sum = Vector3f::Zero();
      for (int v = supersampling * y; v < supersampling * (y + 1); ++v) {
        for (int u = supersampling * x; u < supersampling * (x + 1); ++u) sum += colors[image.index(u, v)];
      }
      picture.pixels.push_back(to_color(sum / samples));
    }
  }
  return picture;
}

}  // namespace

Picture shade(const SurfaceImage& image) {
  constexpr float outline = 0.4F;
  constexpr float glass = 0.13F;
  constexpr float glass_edge = 0.9F;
  const Vector3f glass_color(125, 142, 163);
  const Lights lights(image.camera);
  const std::vector<float> light = light_left(image);
  std::vector<Vector3f> colors;
  colors.reserve(image.samples.size());
  for (int v = 0; v < image.camera.height; ++v) {
    for (int u = 0; u < image.camera.width; ++u) {
      const SurfaceSample& sample = image.at(u, v);
      Vector3f color = to_vector(background_color);
      if (!is_background(sample)) color = light[image.index(u, v)] * lights.shine_on(sample);
      if (any_neighbour(image, u, v, is_beside_nearer_object)) color *= outline;
      if (sample.glass != 0) {
        const float share = any_neighbour(image, u, v, is_edge_of_glass) ? glass_edge : glass;
        color = (1 - share) * color + share * glass_color;
      }
      colors.push_back(color);
    }
  }
  return average(image, colors);
}

}  // namespace tanglebin
