#include "tanglebin/model/axis_votes.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>

#include "tanglebin/model/pixel_grid.hpp"

namespace tanglebin {
namespace {

using Eigen::Matrix3f;
using Eigen::Vector3f;

/// The neighbours of a point, relative to it, in reaches.
struct Neighbourhood {
  int count = 0;
  Vector3f mean;
  Matrix3f covariance;
};

Neighbourhood neighbourhood(const PixelGrid& grid, std::size_t item, float reach) {
  const Vector3f point = grid.items()[item].point;
  const auto [column, row] = grid.pixels()[item];
  const int window = static_cast<int>(std::ceil(grid.pixels_across(reach, point)));
  const float scale = 1 / reach;
  int count = 0;
  Vector3f sum = Vector3f::Zero();
  Vector3f squares = Vector3f::Zero();  // xx, yy, zz
  Vector3f mixed = Vector3f::Zero();    // yz, zx, xy
  for (int v = row - window; v <= row + window; ++v) {
    for (const PixelGrid::Item& neighbour : grid.run(v, column - window, column + window)) {
      const Vector3f d = (neighbour.point - point) * scale;
      if (d.squaredNorm() > 1) continue;
      ++count;
      sum += d;
      squares += d.cwiseProduct(d);
      mixed += Vector3f(d.y() * d.z(), d.z() * d.x(), d.x() * d.y());
    }
  }
  const auto n = static_cast<float>(count);  // at least 1, the point itself
  const Vector3f mean = sum / n;
  Matrix3f products = squares.asDiagonal();
  products(1, 2) = products(2, 1) = mixed.x();
  products(2, 0) = products(0, 2) = mixed.y();
  products(0, 1) = products(1, 0) = mixed.z();
  return {count, mean, products / n - mean * mean.transpose()};
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
  const std::size_t stride = grid.items().size() / looked_at + 1;
  std::vector<float> counts;
  counts.reserve(looked_at);
  for (std::size_t item = 0; item < grid.items().size(); item += stride) {
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
  Eigen::SelfAdjointEigenSolver<Matrix3f> solver;
  solver.computeDirect(around.covariance);
  const Vector3f variances = solver.eigenvalues();
  if (variances(1) < settings.breadth_min) return std::nullopt;
  const Vector3f point = grid.items()[item].point;
  Vector3f normal = solver.eigenvectors().col(0);
  if (normal.dot(known.camera.pose.translation().cast<float>() - point) < 0) normal = -normal;
  // The plane passes below the surface by the mean sagitta of the arc that the neighbours are on: their
  // variance across the tube over its diameter.
  const auto radius = static_cast<float>(known.radius);
  const float sagitta = variances(1) * reach * reach / (2 * radius);
  const Vector3f axis = point + around.mean * reach - normal * (radius - sagitta);
  if (!is_clear_of(bin, axis, radius * (1 - static_cast<float>(settings.bin_tolerance)))) return std::nullopt;
  return Vote{axis, normal, variances(0)};
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
  votes.reserve(grid.items().size());
  std::vector<float> roughness;
  roughness.reserve(grid.items().size());
  for (std::size_t item = 0; item < grid.items().size(); ++item) {
    votes.push_back(vote_of(grid, item, reach, known, bin, settings));
    if (votes.back()) roughness.push_back(votes.back()->roughness);
  }
  if (roughness.empty()) return result;

  // Where two surfaces meet the neighbours are on no plane.
  const float roughness_max = static_cast<float>(settings.roughness_max) * median(std::move(roughness));
  for (std::size_t item = 0; item < votes.size(); ++item) {
    if (!votes[item] || votes[item]->roughness > roughness_max) continue;
    const std::size_t index = grid.items()[item].index;
    result.votes[index] = votes[item]->axis;
    result.normals[index] = votes[item]->normal;
  }
  return result;
}

}  // namespace tanglebin
