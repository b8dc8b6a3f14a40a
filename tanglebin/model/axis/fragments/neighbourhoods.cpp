#include "tanglebin/model/axis/fragments/neighbourhoods.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace tanglebin {
namespace {

using Eigen::Vector3f;

// The method spends most of its time here. So it works on eight numbers at once, with vector instructions
// (GCC manual, "Vector Extensions"; clang has them too).
constexpr std::size_t lanes = points_at_once;
using Lanes [[gnu::vector_size(lanes * sizeof(float))]] = float;
using LaneNumbers [[gnu::vector_size(lanes * sizeof(int))]] = int;  // also truths: −1 if true, else 0

/// A vector and a symmetric matrix of each of some points.
template <typename Numbers>
struct Vectors {
  Numbers x{}, y{}, z{};
};
template <typename Numbers>
struct Matrices {
  Numbers xx{}, yy{}, zz{}, yz{}, zx{}, xy{};
};
using LaneVectors = Vectors<Lanes>;
using LaneMatrices = Matrices<Lanes>;

/// Items of the grid.
template <std::size_t points>
using Items = std::array<std::size_t, points>;

// Numbers of so many neighbours of each of some points.
constexpr std::size_t of_each = 4;
template <std::size_t points>
struct NumbersOf;
template <>
struct NumbersOf<1> {
  using Floats [[gnu::vector_size(of_each * sizeof(float))]] = float;
  using Ints [[gnu::vector_size(of_each * sizeof(int))]] = int;
};
template <>
struct NumbersOf<2> {
  using Floats = Lanes;
  using Ints = LaneNumbers;
};

/// Sums over the neighbours of some points, relative to the points. Four neighbours of each at once.
template <std::size_t points>
struct Sums {
  using Floats = typename NumbersOf<points>::Floats;
  using Ints = typename NumbersOf<points>::Ints;

  Ints count{};
  Vectors<Floats> vectors;
  Matrices<Floats> products;

  [[gnu::always_inline]] void add(const PixelGrid& grid, const std::array<PixelGrid::Run, points>& runs,
                                  const Vectors<Floats>& origin, float reach_squared) {
    Ints numbers{};
    Ints sizes{};
    std::size_t full = runs[0].size;
    std::size_t most = 0;
    for (std::size_t i = 0; i < points; ++i) {
      for (std::size_t lane = 0; lane < of_each; ++lane) {
        numbers[i * of_each + lane] = static_cast<int>(lane);
        sizes[i * of_each + lane] = static_cast<int>(runs[i].size);
      }
      full = std::min(full, runs[i].size);
      most = std::max(most, runs[i].size);
    }
    full -= full % of_each;
    Items<points> items{};
    for (std::size_t n = 0; n < full; n += of_each) {
      for (std::size_t i = 0; i < points; ++i) items[i] = runs[i].first + n;
      add_some(grid, items, ~Ints{}, origin, reach_squared);
    }
    for (std::size_t n = full; n < most; n += of_each) {
      for (std::size_t i = 0; i < points; ++i) items[i] = n < runs[i].size ? runs[i].first + n : 0;
      add_some(grid, items, numbers + static_cast<int>(n) < sizes, origin, reach_squared);
    }
  }

private:
  // Those that exist of the neighbours from these items on.
  [[gnu::always_inline]] void add_some(const PixelGrid& grid, const Items<points>& items, const Ints& exist,
                                       const Vectors<Floats>& origin, float reach_squared) {
    Vectors<Floats> seen;
    load(seen.x, grid.x(), items);
    load(seen.y, grid.y(), items);
    load(seen.z, grid.z(), items);
    const Floats dx = seen.x - origin.x;
    const Floats dy = seen.y - origin.y;
    const Floats dz = seen.z - origin.z;
    const Ints is_near = (dx * dx + dy * dy + dz * dz <= reach_squared) & exist;
    const Floats x = is_near ? dx : Floats{};
    const Floats y = is_near ? dy : Floats{};
    const Floats z = is_near ? dz : Floats{};
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

  [[gnu::always_inline]] static void load(Floats& to, const float* from, const Items<points>& items) {
    std::array<NumbersOf<1>::Floats, points> parts;
    for (std::size_t i = 0; i < points; ++i) std::memcpy(&parts[i], from + items[i], sizeof parts[i]);
    if constexpr (points == 1)
      to = parts[0];
    else
      to = __builtin_shufflevector(parts[0], parts[1], 0, 1, 2, 3, 4, 5, 6, 7);
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

template <std::size_t points>
[[gnu::always_inline]] inline Sums<points> sums_around(const PixelGrid& grid, const std::size_t* items,
                                                       float reach) {
  std::array<PixelGrid::Window, points> windows;
  Vectors<typename Sums<points>::Floats> origin;
  int rows = 0;
  for (std::size_t i = 0; i < points; ++i) {
    windows[i] = window_around(grid, items[i], reach);
    rows = std::max(rows, windows[i].rows());
    const Vector3f point = grid.point(items[i]);
    for (std::size_t lane = i * of_each; lane < (i + 1) * of_each; ++lane) {
      origin.x[lane] = point.x();
      origin.y[lane] = point.y();
      origin.z[lane] = point.z();
    }
  }
  Sums<points> sums;
  for (int row = 0; row < rows; ++row) {
    std::array<PixelGrid::Run, points> runs;
    for (std::size_t i = 0; i < points; ++i) runs[i] = row_of(windows[i], row);
    sums.add(grid, runs, origin, reach * reach);
  }
  return sums;
}

/// The neighbours of eight points.
struct LaneNeighbourhoods {
  LaneNumbers count{};      // with the point itself
  LaneVectors mean;         // m, relative to the point
  LaneMatrices covariance;  // in squares of the reach
};

// Looks at so many points at once.
template <std::size_t points>
[[gnu::always_inline]] inline LaneNeighbourhoods lanes_of(const PixelGrid& grid, const PointItems& items,
                                                          float reach) {
  LaneNeighbourhoods result;
  for (std::size_t first = 0; first < lanes; first += points) {
    const Sums<points> sums = sums_around<points>(grid, items.data() + first, reach);
    const auto sum_up = [&](auto& to, const auto& from) {
      for (std::size_t i = 0; i < points; ++i)
        to[first + i] =
            (from[of_each * i] + from[of_each * i + 1]) + (from[of_each * i + 2] + from[of_each * i + 3]);
    };
    sum_up(result.count, sums.count);
    sum_up(result.mean.x, sums.vectors.x);
    sum_up(result.mean.y, sums.vectors.y);
    sum_up(result.mean.z, sums.vectors.z);
    sum_up(result.covariance.xx, sums.products.xx);
    sum_up(result.covariance.yy, sums.products.yy);
    sum_up(result.covariance.zz, sums.products.zz);
    sum_up(result.covariance.yz, sums.products.yz);
    sum_up(result.covariance.zx, sums.products.zx);
    sum_up(result.covariance.xy, sums.products.xy);
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
/// planes, and their two variances within them, the smaller one first.
struct Planes {
  LaneVectors normal;
  Lanes roughness{};
  Lanes breadth{};
  Lanes length{};
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
  for (std::size_t i = 0; i < lanes; ++i) of[i] = std::sqrt(of[i]);
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
  return {normal, roughness, sum / 2 - difference, sum / 2 + difference};
}

// Sums up the neighbours of so many points at once.
template <std::size_t points>
[[gnu::always_inline]] inline void find(const PixelGrid& grid, const PointItems& items, float reach,
                                        Neighbourhoods& found) {
  const LaneNeighbourhoods neighbours = lanes_of<points>(grid, items, reach);
  const Planes planes = planes_of(neighbours.covariance);
  for (std::size_t i = 0; i < lanes; ++i) {
    const auto vector = [i](const LaneVectors& of) { return Vector3f(of.x[i], of.y[i], of.z[i]); };
    found[i] = {neighbours.count[i], vector(neighbours.mean), vector(planes.normal),
                planes.roughness[i], planes.breadth[i],       planes.length[i]};
  }
}

// With AVX2, a register holds eight numbers, else four.
#ifdef __x86_64__
[[gnu::target("avx2")]] void find_with_avx2(const PixelGrid& grid, const PointItems& items, float reach,
                                            Neighbourhoods& found) {
  find<2>(grid, items, reach, found);
}
#endif

}  // namespace

// The results are the same on every processor.
Neighbourhoods neighbourhoods_of(const PixelGrid& grid, const PointItems& items, float reach) {
  Neighbourhoods found;
#ifdef __x86_64__
  static const bool has_avx2 = __builtin_cpu_supports("avx2") != 0;
  if (has_avx2) {
    find_with_avx2(grid, items, reach, found);
    return found;
  }
#endif
  find<1>(grid, items, reach, found);
  return found;
}

}  // namespace tanglebin
