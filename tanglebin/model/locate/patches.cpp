#include "tanglebin/model/locate/patches.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "tanglebin/base/constants.hpp"
#include "tanglebin/base/median.hpp"
#include "tanglebin/base/random.hpp"

namespace tanglebin {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::Vector3f;

int tile_size(const SensorView& view) {
  constexpr double smallest = 0.008;  // m
  constexpr int fewest_pixels = 10;
  std::vector<float> depths;
  for (const std::size_t i : view.sample(1000)) depths.push_back(view.points[i].z());
  const double pixel = view.pixel_size(median(std::move(depths)));
  return std::max(fewest_pixels, static_cast<int>(std::ceil(smallest / pixel)));
}

/// The first two moments of some points.
struct Moments {
  double weight = 0;
  Vector3d sum = Vector3d::Zero();
  Matrix3d squares = Matrix3d::Zero();

  void add(const Vector3d& point, double w = 1) {
    weight += w;
    sum += w * point;
    squares += w * point * point.transpose();
  }
  Vector3d mean() const { return sum / weight; }
  Matrix3d covariance() const { return squares / weight - mean() * mean().transpose(); }
};

Vector3d towards_camera(const Vector3d& normal, const Vector3d& at) {
  return normal.dot(at) > 0 ? Vector3d(-normal) : normal;
}

// The points of a tile, about one of them: differences of squares lose digits far from the origin.
Moments moments_of_tile(const SensorView& view, int left, int top, int size, const Vector3f& about) {
  Moments moments;
  for (int row = top; row < top + size; ++row) {
    for (int column = left; column < left + size; ++column) {
      const Vector3f point = view.at(column, row);
      if (point.allFinite()) moments.add((point - about).cast<double>());
    }
  }
  return moments;
}

Vector3f first_point(const SensorView& view, int left, int top, int size) {
  for (int row = top; row < top + size; ++row) {
    for (int column = left; column < left + size; ++column) {
      if (view.at(column, row).allFinite()) return view.at(column, row);
    }
  }
  return view.at(-1, -1);
}

void add_patch(const SensorView& view, int left, int top, int size, std::vector<FlatPatch>& patches) {
  constexpr double points_min = 12;
  constexpr double flatness = 0.25;  // largest ratio of variances across and along the plane
  const Vector3f about = first_point(view, left, top, size);
  if (!about.allFinite()) return;
  const Moments moments = moments_of_tile(view, left, top, size, about);
  if (moments.weight < points_min) return;
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(moments.covariance());
  const Vector3d& variances = solver.eigenvalues();
  if (variances[0] > flatness * variances[1]) return;
  const Vector3d centre = moments.mean() + about.cast<double>();
  const Vector3d normal = towards_camera(solver.eigenvectors().col(0), centre);
  constexpr double most_grazing = 0.3;  // cosine; flying pixels at edges look like large steep walls
  const double cosine = std::max(-normal.dot(centre.normalized()), most_grazing);
  const double pixel = view.pixel_size(centre.z());
  patches.push_back({.centre = centre,
                     .normal = normal,
                     .noise = std::sqrt(std::max(variances[0], 0.0)),
                     .area = moments.weight * pixel * pixel / cosine});
}

constexpr double same_direction = 20 * degree;
constexpr double closeness_min = 0.003;  // m

bool lies_on(const FlatPatch& patch, const FlatPlane& plane, double closeness) {
  return std::abs(plane.normal.dot(patch.centre) - plane.offset) < closeness &&
         patch.normal.dot(plane.normal) > std::cos(same_direction);
}

double area_on(const std::vector<FlatPatch>& patches, const FlatPlane& plane, double closeness) {
  double area = 0;
  for (const FlatPatch& patch : patches) {
    if (lies_on(patch, plane, closeness)) area += patch.area;
  }
  return area;
}

FlatPlane plane_with(const Vector3d& normal, const Vector3d& point) {
  const Vector3d towards = towards_camera(normal, point);
  return {.normal = towards, .offset = towards.dot(point), .area = 0, .noise = 0};
}

std::vector<FlatPatch> thinned(const std::vector<FlatPatch>& patches) {
  constexpr std::size_t enough = 2000;
  const std::size_t stride = patches.size() / enough + 1;
  std::vector<FlatPatch> thin;
  for (std::size_t i = 0; i < patches.size(); i += stride) thin.push_back(patches[i]);
  return thin;
}

// The plane with the most area on it, of those through three patches drawn at random.
FlatPlane best_of_draws(const std::vector<FlatPatch>& patches, double closeness, Rng& rng) {
  constexpr int draws = 400;
  const int last = static_cast<int>(patches.size()) - 1;
  const auto draw = [&] { return patches[static_cast<std::size_t>(uniform_integer(rng, 0, last))]; };
  FlatPlane best = plane_with(patches[0].normal, patches[0].centre);
  for (int i = 0; i < draws; ++i) {
    const FlatPatch first = draw();
    FlatPlane plane = plane_with(first.normal, first.centre);
    const FlatPatch second = draw();
    const FlatPatch third = draw();
    const double loose = 0.1 * (second.centre - first.centre).norm() + closeness;
    if (lies_on(second, plane, loose) && lies_on(third, plane, loose)) {
      const Vector3d normal = (second.centre - first.centre).cross(third.centre - first.centre);
      if (normal.norm() > 1e-6) plane = plane_with(normal.normalized(), first.centre);
    }
    plane.area = area_on(patches, plane, closeness);
    if (plane.area > best.area) best = plane;
  }
  return best;
}

// The plane of least squares through the patches on it.
FlatPlane refined(const std::vector<FlatPatch>& patches, FlatPlane plane, double closeness) {
  constexpr int rounds = 4;
  for (int i = 0; i < rounds; ++i) {
    Moments moments;
    std::vector<double> noise;
    for (const FlatPatch& patch : patches) {
      if (!lies_on(patch, plane, closeness)) continue;
      moments.add(patch.centre, patch.area);
      noise.push_back(patch.noise);
    }
    if (noise.size() < 3) return plane;
    const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(moments.covariance());
    const Vector3d normal = solver.eigenvectors().col(0);
    if (std::abs(normal.dot(plane.normal)) < std::cos(same_direction)) return plane;  // all on a line
    plane = plane_with(normal, moments.mean());
    plane.area = moments.weight;
    plane.noise = median(std::move(noise));
  }
  return plane;
}

}  // namespace

std::vector<FlatPatch> patches_of(const SensorView& view) {
  const int size = tile_size(view);
  std::vector<FlatPatch> patches;
  for (int top = 0; top < view.camera.height; top += size) {
    for (int left = 0; left < view.camera.width; left += size) add_patch(view, left, top, size, patches);
  }
  return patches;
}

std::vector<FlatPlane> planes_of(const std::vector<FlatPatch>& patches) {
  constexpr std::size_t most = 12;
  constexpr std::size_t patches_min = 10;
  constexpr double smallest = 0.005;  // share of the area
  constexpr std::uint64_t seed = 18;
  Rng rng(seed);
  double area = 0;
  std::vector<double> noise;
  for (const FlatPatch& patch : patches) {
    area += patch.area;
    noise.push_back(patch.noise);
  }
  if (noise.empty()) return {};
  const double closeness = std::max(closeness_min, 2 * median(std::move(noise)));
  std::vector<FlatPatch> left = patches;
  std::vector<FlatPlane> planes;
  while (planes.size() < most && left.size() >= patches_min) {
    const FlatPlane plane = refined(left, best_of_draws(thinned(left), closeness, rng), closeness);
    if (plane.area < smallest * area) break;
    planes.push_back(plane);
    std::erase_if(left, [&](const FlatPatch& patch) { return lies_on(patch, plane, 2 * closeness); });
  }
  std::ranges::sort(planes, [](const FlatPlane& a, const FlatPlane& b) { return a.area > b.area; });
  return planes;
}

}  // namespace tanglebin
