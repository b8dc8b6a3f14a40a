#include "tanglebin/model/axis_votes.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>
#include <optional>

#include "tanglebin/model/pixel_grid.hpp"

namespace tanglebin {
namespace {

using Eigen::Matrix3f;
using Eigen::Vector3f;

// Four numbers that the processor's vector instructions treat at once (GCC manual, "Vector Extensions"; clang
// has them too). This is where the method spends its time.
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

/// Sums over the neighbours of a point, relative to it.
struct Sums {
  LaneNumbers count{};
  Lanes x{}, y{}, z{}, xx{}, yy{}, zz{}, yz{}, zx{}, xy{};

  void add(const PixelGrid::Run& run, const Vector3f& origin, float reach_squared) {
    constexpr LaneNumbers numbers = {0, 1, 2, 3};
    for (int first = 0; first < run.size; first += lanes) {
      const Lanes dx = load(run.x + first) - origin.x();
      const Lanes dy = load(run.y + first) - origin.y();
      const Lanes dz = load(run.z + first) - origin.z();
      // −1 where it is true, 0 elsewhere.
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
  int count;            ///< with the point itself
  Vector3f mean;        ///< m, relative to the point
  Matrix3f covariance;  ///< in squares of the reach
};

Neighbourhood neighbourhood(const PixelGrid& grid, std::size_t item, float reach) {
  const Vector3f point = grid.point(item);
  const auto [column, row] = grid.pixels()[item];
  const int window = static_cast<int>(std::ceil(grid.pixels_across(reach, point)));
  Sums sums;
  for (int v = row - window; v <= row + window; ++v) {
    sums.add(grid.run(v, column - window, column + window), point, reach * reach);
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

/// The plane through some points: its unit normal, the points' variance about it, and the lesser of their two
/// variances in it.
struct Plane {
  Vector3f normal;
  float roughness;
  float breadth;
};

// The principal directions of the points, by their covariance. The least is the greatest of the adjugate,
// which taken to the eighth power has nothing but that direction left.
Plane plane_of(const Matrix3f& covariance) {
  Matrix3f adjugate;
  adjugate.col(0) = covariance.col(1).cross(covariance.col(2));
  adjugate.col(1) = covariance.col(2).cross(covariance.col(0));
  adjugate.col(2) = covariance.col(0).cross(covariance.col(1));
  const float minors = adjugate.trace();  // the sum of the products of two variances
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

float median(std::vector<float> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

// The reach within which points have about as many neighbours as wanted, from some of them.
float suitable_reach(const PixelGrid& grid, float radius, const VoteSettings& settings) {
  const auto most = static_cast<float>(settings.reach_max) * radius;
  const auto least = static_cast<float>(settings.reach_min) * radius;
  constexpr std::size_t looked_at = 500;
  const std::size_t stride = grid.size() / looked_at + 1;
  std::vector<float> counts;
  counts.reserve(looked_at);
  for (std::size_t item = 0; item < grid.size(); item += stride) {
    counts.push_back(static_cast<float>(neighbourhood(grid, item, most).count));
  }
  if (counts.empty()) return most;
  return std::clamp(most * std::sqrt(static_cast<float>(settings.neighbours) / median(std::move(counts))),
                    least, most);
}

/// Floor and walls of a bin, single precision.
using BinBoxes = std::array<Eigen::AlignedBox3f, 5>;

BinBoxes boxes_of(const Bin& bin) {
  BinBoxes result;
  std::ranges::transform(boxes(bin), result.begin(),
                         [](const auto& box) { return box.template cast<float>(); });
  return result;
}

bool is_clear_of(const BinBoxes& bin, const Vector3f& axis, float clearance) {
  return std::ranges::none_of(
      bin, [&](const auto& box) { return box.squaredExteriorDistance(axis) < clearance * clearance; });
}

std::vector<Vector3f> without_floor(const std::vector<Vector3f>& points, double margin) {
  std::vector<Vector3f> kept = points;
  for (Vector3f& point : kept) {
    if (point.z() < margin) point.setConstant(std::numeric_limits<float>::quiet_NaN());
  }
  return kept;
}

/// A vote and how far the neighbours are from being a plane.
struct Vote {
  Vector3f axis;
  Vector3f normal;
  float roughness;
};

std::optional<Vote> vote_of(const PixelGrid& grid, std::size_t item, float reach, const KnownScene& known,
                            const BinBoxes& bin, const VoteSettings& settings) {
  const Neighbourhood around = neighbourhood(grid, item, reach);
  if (around.count < settings.neighbours_min) return std::nullopt;
  const Plane plane = plane_of(around.covariance);
  if (!(plane.breadth >= settings.breadth_min)) return std::nullopt;
  const Vector3f point = grid.point(item);
  Vector3f normal = plane.normal;
  if (normal.dot(known.camera.pose.translation().cast<float>() - point) < 0) normal = -normal;
  // The plane passes below the surface by the mean sagitta of the arc that the neighbours are on: their
  // variance across the tube over its diameter.
  const auto radius = static_cast<float>(known.radius);
  const float sagitta = plane.breadth * reach * reach / (2 * radius);
  const Vector3f axis = point + around.mean - normal * (radius - sagitta);
  if (!is_clear_of(bin, axis, radius * (1 - static_cast<float>(settings.bin_tolerance)))) return std::nullopt;
  return Vote{axis, normal, plane.roughness};
}

}  // namespace

AxisVotes vote_for_axes(const std::vector<Vector3f>& points, const KnownScene& known,
                        const VoteSettings& settings) {
  const Vector3f nothing = Vector3f::Constant(std::numeric_limits<float>::quiet_NaN());
  AxisVotes result{std::vector(points.size(), nothing), std::vector(points.size(), nothing)};

  const PixelGrid grid(without_floor(points, settings.floor_margin * known.radius), known.camera);
  const float reach = suitable_reach(grid, static_cast<float>(known.radius), settings);
  const BinBoxes bin = boxes_of(known.bin);
  std::vector<std::optional<Vote>> votes;
  votes.reserve(grid.size());
  std::vector<float> roughness;
  roughness.reserve(grid.size());
  for (std::size_t item = 0; item < grid.size(); ++item) {
    votes.push_back(vote_of(grid, item, reach, known, bin, settings));
    if (votes.back()) roughness.push_back(votes.back()->roughness);
  }
  if (roughness.empty()) return result;

  // Where two surfaces meet the neighbours are on no plane.
  const float roughness_max = static_cast<float>(settings.roughness_max) * median(std::move(roughness));
  for (std::size_t item = 0; item < votes.size(); ++item) {
    if (!votes[item] || votes[item]->roughness > roughness_max) continue;
    const std::size_t index = grid.indices()[item];
    result.votes[index] = votes[item]->axis;
    result.normals[index] = votes[item]->normal;
  }
  return result;
}

}  // namespace tanglebin
