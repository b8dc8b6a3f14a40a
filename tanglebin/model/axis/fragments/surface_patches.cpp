#include "tanglebin/model/axis/fragments/surface_patches.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "tanglebin/base/median.hpp"

namespace tanglebin {
namespace {

using Eigen::Matrix3f;
using Eigen::Vector3f;

// Four numbers for the processor's vector instructions (GCC manual, "Vector Extensions"; clang has them too).
// The method spends most of its time here.
constexpr int lanes = 4;
using Lanes [[gnu::vector_size(lanes * sizeof(float))]] = float;
using LaneNumbers [[gnu::vector_size(lanes * sizeof(int))]] = int;

Lanes load(const float* from) {
  Lanes result;
  std::memcpy(&result, from, sizeof result);
  return result;
}

auto sum(auto values) {
  return (values[0] + values[1]) + (values[2] + values[3]);
}

/// Sums over the neighbours of a point, relative to the point.
struct Sums {
  LaneNumbers count{};
  Lanes x{}, y{}, z{}, xx{}, yy{}, zz{}, yz{}, zx{}, xy{};

  void add(const PixelGrid::Run& run, const Vector3f& origin, float reach_squared) {
    constexpr LaneNumbers numbers = {0, 1, 2, 3};
    for (int first = 0; first < run.size; first += lanes) {
      const Lanes dx = load(run.x + first) - origin.x();
      const Lanes dy = load(run.y + first) - origin.y();
      const Lanes dz = load(run.z + first) - origin.z();
      // −1 if true, else 0.
      const LaneNumbers is_near =
          (dx * dx + dy * dy + dz * dz <= reach_squared) & (numbers < run.size - first);
      const Lanes near_x = is_near ? dx : Lanes{};
      const Lanes near_y = is_near ? dy : Lanes{};
      const Lanes near_z = is_near ? dz : Lanes{};
      count -= is_near;
      x += near_x;
      y += near_y;
      z += near_z;
      xx += near_x * near_x;
      yy += near_y * near_y;
      zz += near_z * near_z;
      yz += near_y * near_z;
      zx += near_z * near_x;
      xy += near_x * near_y;
    }
  }
};

/// The neighbours of a point.
struct Neighbourhood {
  int count;            ///< includes the point itself
  Vector3f mean;        ///< m, relative to the point
  Matrix3f covariance;  ///< in squares of the reach
};

Neighbourhood neighbourhood(const PixelGrid& grid, std::size_t item, float reach) {
  const Vector3f point = grid.point(item);
  const auto [column, row] = grid.pixels()[item];
  // Rounded up from half a pixel, because points need not lie at the centres of their pixels.
  const auto window = static_cast<int>(std::lround(grid.pixels_across(reach, point)));
  constexpr int points_of_a_row =
      1000;  // there are more only where a camera that is none has many in a pixel
  Sums sums;
  for (int v = row - window; v <= row + window; ++v) {
    PixelGrid::Run run = grid.run(v, column - window, column + window);
    run.size = std::min(run.size, points_of_a_row);
    sums.add(run, point, reach * reach);
  }
  const int count = sum(sums.count);
  const auto n = static_cast<float>(count);
  const Vector3f mean = Vector3f(sum(sums.x), sum(sums.y), sum(sums.z)) / n;
  Matrix3f products = Vector3f(sum(sums.xx), sum(sums.yy), sum(sums.zz)).asDiagonal();
  products(1, 2) = products(2, 1) = sum(sums.yz);
  products(2, 0) = products(0, 2) = sum(sums.zx);
  products(0, 1) = products(1, 0) = sum(sums.xy);
  return {count, mean, (products / n - mean * mean.transpose()) / (reach * reach)};
}

/// The plane through some points: its unit normal, the points' variance about it, and the smaller of their
/// two variances within it.
struct Plane {
  Vector3f normal;
  float roughness;
  float breadth;
};

// Principal components of the points from their covariance. The direction of least variance is the adjugate's
// dominant eigenvector; in the adjugate's eighth power only that direction remains.
Plane plane_of(const Matrix3f& covariance) {
  Matrix3f adjugate;
  adjugate.col(0) = covariance.col(1).cross(covariance.col(2));
  adjugate.col(1) = covariance.col(2).cross(covariance.col(0));
  adjugate.col(2) = covariance.col(0).cross(covariance.col(1));
  const float minors = adjugate.trace();  // sum of the products of two variances
  Matrix3f power = adjugate;
  for (int i = 0; i < 3; ++i) {
    power /= power.trace();
    power = (power * power).eval();
  }
  Eigen::Index longest = 0;
  power.diagonal().maxCoeff(&longest);
  const Vector3f normal = power.col(longest).normalized();
  const float roughness = normal.dot(covariance * normal);
  const float sum = covariance.trace() - roughness;
  const float product = minors - roughness * sum;
  return {normal, roughness, sum / 2 - std::sqrt(std::max(0.0F, sum * sum / 4 - product))};
}

std::optional<Patch> patch_at(const PixelGrid& grid, std::size_t item, float reach,
                              const PatchSettings& settings) {
  const Neighbourhood around = neighbourhood(grid, item, reach);
  if (around.count < settings.neighbours_min) return std::nullopt;
  const Plane plane = plane_of(around.covariance);
  if (!(plane.breadth >= settings.breadth_min)) return std::nullopt;
  const Vector3f to_sensor = grid.camera().pose.translation().cast<float>() - grid.point(item);
  const bool is_turned_away = plane.normal.dot(to_sensor) < 0;
  return Patch{around.mean, is_turned_away ? -plane.normal : plane.normal, plane.roughness, plane.breadth};
}

}  // namespace

float suitable_reach(const PixelGrid& grid, double radius, const PatchSettings& settings) {
  const auto most = static_cast<float>(settings.reach_max * radius);
  const auto least = static_cast<float>(settings.reach_min * radius);
  constexpr std::size_t looked_at = 500;
  const std::size_t stride = grid.size() / looked_at + 1;
  std::vector<float> counts;
  counts.reserve(looked_at);
  for (std::size_t item = 0; item < grid.size(); item += stride) {
    counts.push_back(static_cast<float>(neighbourhood(grid, item, most).count));
  }
  if (counts.empty()) return most;
  const float wanted = static_cast<float>(settings.neighbours) / median(std::move(counts));
  // Not std::clamp(): the settings may have a least reach above the greatest, which then counts.
  return std::min(std::max(most * std::sqrt(wanted), least), most);
}

std::vector<std::optional<Patch>> surface_patches(const PixelGrid& grid, float reach, double radius,
                                                  const PatchSettings& settings) {
  std::vector<std::optional<Patch>> patches;
  patches.reserve(grid.size());
  std::vector<float> roughness;
  roughness.reserve(grid.size());
  for (std::size_t item = 0; item < grid.size(); ++item) {
    patches.push_back(patch_at(grid, item, reach, settings));
    if (patches.back()) roughness.push_back(patches.back()->roughness);
  }
  if (roughness.empty()) return patches;
  // Of a disc on a cylinder: the variance of x² / 2r.
  const auto share = reach / static_cast<float>(radius);
  const float of_a_tube = share * share / 64;
  const float most =
      static_cast<float>(settings.roughness_max) * std::max(of_a_tube, median(std::move(roughness)));
  for (std::optional<Patch>& patch : patches) {
    if (patch && patch->roughness > most) patch.reset();
  }
  return patches;
}

}  // namespace tanglebin
