#include "tanglebin/model/axis/fragments/surface_patches.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <utility>

#include "tanglebin/base/median.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3f;

// The method spends most of its time here. So it works on eight numbers at once, with vector instructions
// (GCC manual, "Vector Extensions"; clang has them too). The results are the same on every processor; one
// with AVX2 needs half the time.
#ifdef __x86_64__
#define TANGLEBIN_BY_PROCESSOR [[gnu::target_clones("avx2", "default")]]
#else
#define TANGLEBIN_BY_PROCESSOR
#endif
constexpr int lanes = 8;
using Lanes [[gnu::vector_size(lanes * sizeof(float))]] = float;
using LaneNumbers [[gnu::vector_size(lanes * sizeof(int))]] = int;  // also truths: −1 if true, else 0

/// A vector and a symmetric matrix of each of eight points.
struct LaneVectors {
  Lanes x{}, y{}, z{};
};
struct LaneMatrices {
  Lanes xx{}, yy{}, zz{}, yz{}, zx{}, xy{};
};

// Of two points, four neighbours each.
constexpr std::size_t neighbours = lanes / 2;

// Not returned, because without AVX2 there is no common way to return so much.
[[gnu::always_inline]] inline void load(Lanes& to, const float* of_first, const float* of_second) {
  using Half [[gnu::vector_size(neighbours * sizeof(float))]] = float;
  Half first;
  Half second;
  std::memcpy(&first, of_first, sizeof first);
  std::memcpy(&second, of_second, sizeof second);
  to = __builtin_shufflevector(first, second, 0, 1, 2, 3, 4, 5, 6, 7);
}

/// Sums over the neighbours of two points, relative to the points.
struct Sums {
  LaneNumbers count{};
  LaneVectors vectors;
  LaneMatrices products;

  [[gnu::always_inline]] void add(const PixelGrid& grid, const PixelGrid::Run& first,
                                  const PixelGrid::Run& second, const LaneVectors& points,
                                  float reach_squared) {
    constexpr LaneNumbers numbers = {0, 1, 2, 3, 0, 1, 2, 3};
    const auto a = static_cast<int>(first.size);
    const auto b = static_cast<int>(second.size);
    const LaneNumbers sizes = {a, a, a, a, b, b, b, b};
    const std::size_t full = std::min(first.size, second.size) / neighbours * neighbours;
    for (std::size_t i = 0; i < full; i += neighbours)
      add_some(grid, first.first + i, second.first + i, ~LaneNumbers{}, points, reach_squared);
    for (std::size_t i = full; i < std::max(first.size, second.size); i += neighbours)
      add_some(grid, i < first.size ? first.first + i : 0, i < second.size ? second.first + i : 0,
               numbers + static_cast<int>(i) < sizes, points, reach_squared);
  }

private:
  // Those that exist of the neighbours from these items on.
  [[gnu::always_inline]] void add_some(const PixelGrid& grid, std::size_t of_first, std::size_t of_second,
                                       const LaneNumbers& exist, const LaneVectors& points,
                                       float reach_squared) {
    LaneVectors seen;
    load(seen.x, grid.x() + of_first, grid.x() + of_second);
    load(seen.y, grid.y() + of_first, grid.y() + of_second);
    load(seen.z, grid.z() + of_first, grid.z() + of_second);
    const Lanes dx = seen.x - points.x;
    const Lanes dy = seen.y - points.y;
    const Lanes dz = seen.z - points.z;
    const LaneNumbers is_near = (dx * dx + dy * dy + dz * dz <= reach_squared) & exist;
    const Lanes x = is_near ? dx : Lanes{};
    const Lanes y = is_near ? dy : Lanes{};
    const Lanes z = is_near ? dz : Lanes{};
    count -= is_near;
    vectors.x += x;
    vectors.y += y;
    vectors.z += z;
    products.xx += x * x;
    products.yy += y * y;
    products.zz += z * z;
    products.yz += y * z;
    products.zx += z * x;
    products.xy += x * y;
  }
};

// Rounded up from half a pixel, because points need not lie at the centres of their pixels.
PixelGrid::Window window_around(const PixelGrid& grid, std::size_t item, float reach) {
  const double pixels = grid.pixels_across(reach, grid.point(item));
  return grid.window(grid.pixels()[item], static_cast<int>(std::lround(pixels)));
}

// A row has more points than the most only where a camera that is none has many in a pixel.
PixelGrid::Run row_of(const PixelGrid::Window& window, int number) {
  constexpr std::size_t most = 1000;
  PixelGrid::Run row = window.row(window.first_row() + number);
  row.size = std::min(row.size, most);
  return row;
}

[[gnu::always_inline]] inline Sums sums_around(const PixelGrid& grid, std::size_t first, std::size_t second,
                                               float reach) {
  const PixelGrid::Window of_first = window_around(grid, first, reach);
  const PixelGrid::Window of_second = window_around(grid, second, reach);
  const Vector3f a = grid.point(first);
  const Vector3f b = grid.point(second);
  const LaneVectors points{{a.x(), a.x(), a.x(), a.x(), b.x(), b.x(), b.x(), b.x()},
                           {a.y(), a.y(), a.y(), a.y(), b.y(), b.y(), b.y(), b.y()},
                           {a.z(), a.z(), a.z(), a.z(), b.z(), b.z(), b.z(), b.z()}};
  const int rows = std::max(of_first.rows(), of_second.rows());
  Sums sums;
  for (int row = 0; row < rows; ++row)
    sums.add(grid, row_of(of_first, row), row_of(of_second, row), points, reach * reach);
  return sums;
}

/// Eight points, by their items in the grid.
using Items = std::array<std::size_t, lanes>;

/// The neighbours of eight points.
struct Neighbourhoods {
  LaneNumbers count{};      // with the point itself
  LaneVectors mean;         // m, relative to the point
  LaneMatrices covariance;  // in squares of the reach
};

[[gnu::always_inline]] inline Neighbourhoods neighbourhoods_of(const PixelGrid& grid, const Items& items,
                                                               float reach) {
  Neighbourhoods result;
  const auto sum_up = [](auto& to, const auto& from, int point) {
    to[point] = (from[0] + from[1]) + (from[2] + from[3]);
    to[point + 1] = (from[4] + from[5]) + (from[6] + from[7]);
  };
  for (int point = 0; point < lanes; point += 2) {
    const auto first = static_cast<std::size_t>(point);
    const Sums sums = sums_around(grid, items[first], items[first + 1], reach);
    sum_up(result.count, sums.count, point);
    sum_up(result.mean.x, sums.vectors.x, point);
    sum_up(result.mean.y, sums.vectors.y, point);
    sum_up(result.mean.z, sums.vectors.z, point);
    sum_up(result.covariance.xx, sums.products.xx, point);
    sum_up(result.covariance.yy, sums.products.yy, point);
    sum_up(result.covariance.zz, sums.products.zz, point);
    sum_up(result.covariance.yz, sums.products.yz, point);
    sum_up(result.covariance.zx, sums.products.zx, point);
    sum_up(result.covariance.xy, sums.products.xy, point);
  }
  const Lanes n = __builtin_convertvector(result.count, Lanes);
  const float square = reach * reach;
  auto& [count, mean, of] = result;
  mean.x /= n;
  mean.y /= n;
  mean.z /= n;
  of.xx = (of.xx / n - mean.x * mean.x) / square;
  of.yy = (of.yy / n - mean.y * mean.y) / square;
  of.zz = (of.zz / n - mean.z * mean.z) / square;
  of.yz = (of.yz / n - mean.y * mean.z) / square;
  of.zx = (of.zx / n - mean.z * mean.x) / square;
  of.xy = (of.xy / n - mean.x * mean.y) / square;
  return result;
}

/// The planes through the neighbours of eight points: unit normals, the neighbours' variances about the
/// planes, and the smaller of their two variances within them.
struct Planes {
  LaneVectors normal;
  Lanes roughness{};
  Lanes breadth{};
};

[[gnu::always_inline]] inline LaneMatrices adjugate_of(const LaneMatrices& m) {
  return {m.yy * m.zz - m.yz * m.yz, m.zz * m.xx - m.zx * m.zx, m.xx * m.yy - m.xy * m.xy,
          m.zx * m.xy - m.yz * m.xx, m.xy * m.yz - m.zx * m.yy, m.yz * m.zx - m.xy * m.zz};
}

[[gnu::always_inline]] inline LaneMatrices square_of(const LaneMatrices& m) {
  return {m.xx * m.xx + (m.xy * m.xy + m.zx * m.zx), m.xy * m.xy + (m.yy * m.yy + m.yz * m.yz),
          m.zx * m.zx + (m.yz * m.yz + m.zz * m.zz), m.xy * m.zx + (m.yy * m.yz + m.yz * m.zz),
          m.xx * m.zx + (m.xy * m.yz + m.zx * m.zz), m.xx * m.xy + (m.xy * m.yy + m.zx * m.yz)};
}

[[gnu::always_inline]] inline void take_roots(Lanes& of) {
  for (int i = 0; i < lanes; ++i) of[i] = std::sqrt(of[i]);
}

// Principal components of the points from their covariance. The direction of least variance is the adjugate's
// dominant eigenvector; in the adjugate's eighth power only that direction remains.
[[gnu::always_inline]] inline Planes planes_of(const LaneMatrices& covariance) {
  const LaneMatrices adjugate = adjugate_of(covariance);
  const Lanes minors = adjugate.xx + (adjugate.yy + adjugate.zz);  // sum of the products of two variances
  LaneMatrices power = adjugate;
  for (int i = 0; i < 3; ++i) {
    const Lanes trace = power.xx + (power.yy + power.zz);
    for (Lanes* element : {&power.xx, &power.yy, &power.zz, &power.yz, &power.zx, &power.xy})
      *element /= trace;
    power = square_of(power);
  }
  // The column that is longest.
  const LaneNumbers is_x = (power.xx >= power.yy) & (power.xx >= power.zz);
  const LaneNumbers is_y = power.yy >= power.zz;
  LaneVectors normal{is_x ? power.xx : (is_y ? power.xy : power.zx),
                     is_x ? power.xy : (is_y ? power.yy : power.yz),
                     is_x ? power.zx : (is_y ? power.yz : power.zz)};
  Lanes length = normal.x * normal.x + (normal.y * normal.y + normal.z * normal.z);
  take_roots(length);
  normal.x /= length;
  normal.y /= length;
  normal.z /= length;
  const auto& [xx, yy, zz, yz, zx, xy] = covariance;
  const Lanes roughness = normal.x * (xx * normal.x + (xy * normal.y + zx * normal.z)) +
                          (normal.y * (xy * normal.x + (yy * normal.y + yz * normal.z)) +
                           normal.z * (zx * normal.x + (yz * normal.y + zz * normal.z)));
  const Lanes sum = xx + (yy + zz) - roughness;
  const Lanes product = minors - roughness * sum;
  Lanes difference = sum * sum / 4 - product;
  difference = difference > 0 ? difference : Lanes{};
  take_roots(difference);
  return {normal, roughness, sum / 2 - difference};
}

/// The surfaces around eight points.
struct Surfaces {
  Neighbourhoods neighbourhoods;
  Planes planes;
};

TANGLEBIN_BY_PROCESSOR
void look_around(const PixelGrid& grid, const Items& items, float reach, Surfaces& result) {
  result.neighbourhoods = neighbourhoods_of(grid, items, reach);
  result.planes = planes_of(result.neighbourhoods.covariance);
}

// Every so many items, from the first one on; in place of items that are none, the last one.
Items items_from(std::size_t first, std::size_t stride, std::size_t size) {
  Items items{};
  for (std::size_t i = 0; i < items.size(); ++i) items[i] = std::min(first + i * stride, size - 1);
  return items;
}

std::optional<Patch> patch_at(const PixelGrid& grid, std::size_t item, const Surfaces& around, int lane,
                              const PatchSettings& settings) {
  const auto& [neighbourhoods, planes] = around;
  if (neighbourhoods.count[lane] < settings.neighbours_min) return std::nullopt;
  if (!(planes.breadth[lane] >= settings.breadth_min)) return std::nullopt;
  const auto vector = [&](const LaneVectors& of) { return Vector3f(of.x[lane], of.y[lane], of.z[lane]); };
  const Vector3f normal = vector(planes.normal);
  const Vector3f to_sensor = grid.camera().pose.translation().cast<float>() - grid.point(item);
  const bool is_turned_away = normal.dot(to_sensor) < 0;
  return Patch{vector(neighbourhoods.mean), is_turned_away ? -normal : normal, planes.roughness[lane],
               planes.breadth[lane]};
}

}  // namespace

float suitable_reach(const PixelGrid& grid, double radius, const PatchSettings& settings) {
  const auto most = static_cast<float>(settings.reach_max * radius);
  const auto least = static_cast<float>(settings.reach_min * radius);
  constexpr std::size_t looked_at = 500;
  const std::size_t stride = grid.size() / looked_at + 1;
  std::vector<float> counts;
  counts.reserve(looked_at);
  Surfaces around;
  for (std::size_t first = 0; first < grid.size(); first += lanes * stride) {
    look_around(grid, items_from(first, stride, grid.size()), most, around);
    for (std::size_t i = 0; i < lanes && first + i * stride < grid.size(); ++i)
      counts.push_back(static_cast<float>(around.neighbourhoods.count[i]));
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
  Surfaces around;
  for (std::size_t item = 0; item < grid.size(); ++item) {
    const int lane = static_cast<int>(item % lanes);
    if (lane == 0) look_around(grid, items_from(item, 1, grid.size()), reach, around);
    patches.push_back(patch_at(grid, item, around, lane, settings));
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
