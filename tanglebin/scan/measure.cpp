#include "tanglebin/scan/measure.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "tanglebin/base/counter_random.hpp"
#include "tanglebin/scan/filters.hpp"
#include "tanglebin/scan/illumination.hpp"
#include "tanglebin/scan/range_error.hpp"
#include "tanglebin/scan/terms.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double farthest_lateral_shift = 6;  // pixels, for the Kinect's noise

/// What one ray of a footprint hit.
struct Hit {
  Ray ray;
  double depth;  // m, along the optical axis
  LabelledHit first;
};

/// What a footprint sees of a tube, or of the bin.
struct Share {
  double signal;
  Hit nearest;
};

/// What a pixel sees.
struct Sight {
  double depth;
  Vector3d normal;
  double incidence;  // rad
  std::int32_t label;
  double snr;  // 0: no light
  bool mixed;
};

/// Distance, in pixels, of the neighbours that show whether a footprint may straddle an edge. The square of
/// their centres contains the footprint.
int reach_of(const Sensor& sensor) {
  return static_cast<int>(std::ceil(sensor.footprint / 2));
}

/// True if two neighbouring pixels see one smooth surface. The limit of half an edge's jump leaves room for a
/// surface that gets steeper between them.
bool see_one_surface(const Pixel& a, const Pixel& b, double edge_jump) {
  return a.label == b.label && (a.label == null_label || std::abs(a.depth - b.depth) <= edge_jump / 2);
}

/// Marks the pixels of the window whose footprint may straddle an edge.
std::vector<bool> near_edges(const Scan& ideal, const Sensor& sensor) {
  const PixelWindow& window = ideal.window;
  const auto width = static_cast<std::size_t>(window.width);
  const auto index = [&](int column, int row) {
    return static_cast<std::size_t>(row) * width + static_cast<std::size_t>(column);
  };
  std::vector<bool> near(ideal.pixels.size());
  const int reach = reach_of(sensor);
  const auto compare = [&](int column, int row, int other_column, int other_row) {
    if (other_column < 0 || other_column >= window.width || other_row >= window.height) return;
    const std::size_t i = index(column, row);
    const std::size_t j = index(other_column, other_row);
    if (!see_one_surface(ideal.pixels[i], ideal.pixels[j], sensor.edge_jump)) near[i] = near[j] = true;
  };
  for (int row = 0; row < window.height; ++row) {
    for (int column = 0; column < window.width; ++column) {
      for (int right = 1; right <= reach; ++right) compare(column, row, column + right, row);
      for (int down = 1; down <= reach; ++down) {
        for (int right = -reach; right <= reach; ++right) compare(column, row, column + right, row + down);
      }
    }
  }
  return near;
}

/// Walks through an ideal scan tile by tile and replaces each pixel by its measurement.
class Measurement {
public:
  Measurement(const Surfaces& surfaces, Scan ideal, const Sensor& sensor, const ScanSeeds& seeds)
      : surfaces_(surfaces),
        scan_(std::move(ideal)),
        camera_(scan_.camera),
        sensor_(sensor),
        optical_axis_(camera_.pose.linear().col(2)),
        illumination_(surfaces, camera_, sensor, seeds.scene),
        noise_(sensor, camera_, scan_.window, seeds.scanner),
        dropout_(random_of(seeds.scanner, Term::dropout)),
        lateral_(random_of(seeds.scanner, Term::kinect_lateral)) {
    if (sensor.edges != Edges::keep) near_edge_ = near_edges(scan_, sensor);
    if (sensor.trueness > 0) trueness_ = trueness_errors(sensor, scan_.window, seeds.scanner);
    if (const double margin = ray_margin(sensor); margin > 0) index_.emplace(surfaces, camera_, margin);
  }

  Scan run() {
    scan_.snr.resize(scan_.pixels.size());
    scan_.mixed.resize(scan_.pixels.size());
    const PixelWindow& window = scan_.window;
    const int size = index_ ? index_->tile_size() : std::max(window.width, 1);
    for (int top = window.top; top < window.top + window.height; top += size) {
      for (int left = window.left; left < window.left + window.width; left += size) {
        measure_tile(left, top, size);
      }
    }
    return std::move(scan_);
  }

private:
  void measure_tile(int left, int top, int size) {
    tile_left_ = left;
    tile_top_ = top;
    candidates_are_found_ = false;
    const PixelWindow& window = scan_.window;
    for (int v = top; v < std::min(top + size, window.top + window.height); ++v) {
      for (int u = left; u < std::min(left + size, window.left + window.width); ++u) measure_pixel(u, v);
    }
  }

  void measure_pixel(int u, int v) {
    const std::size_t i = scan_.index(u, v);
    const Vector2d shift = sensor_.kinect_noise ? lateral_shift(u, v) : Vector2d::Zero();
    const std::optional<Sight> sight = see(u, v, i, shift);
    if (sight && is_strong_enough(*sight) && !drops_out(u, v)) {
      record(u, v, i, *sight);
    } else {
      scan_.pixels[i] = empty_pixel();
    }
  }

  std::uint64_t number_of(int u, int v) const {
    return static_cast<std::uint64_t>(v) * static_cast<std::uint64_t>(camera_.width) +
           static_cast<std::uint64_t>(u);
  }

  bool drops_out(int u, int v) const {
    return sensor_.dropout > 0 && dropout_.uniform(number_of(u, v)) < sensor_.dropout;
  }

  bool is_strong_enough(const Sight& sight) const {
    if (!sensor_.signal) return sight.snr > 0;
    return sight.snr > 0 && sight.snr >= sensor_.snr_min && sight.snr <= sensor_.snr_max;
  }

  Vector2d lateral_shift(int u, int v) const {
    const Pixel& pixel = scan_.at(u, v);
    const double sigma = kinect_lateral_sigma(pixel.label == null_label ? 0 : pixel.incidence);
    const auto along = [&](std::uint64_t axis) {
      return std::clamp(sigma * lateral_.normal(2 * number_of(u, v) + axis), -farthest_lateral_shift,
                        farthest_lateral_shift);
    };
    return {along(0), along(1)};
  }

  std::optional<Sight> see(int u, int v, std::size_t i, const Vector2d& shift) {
    const bool may_be_edge = !near_edge_.empty() && (near_edge_[i] || sensor_.kinect_noise);
    if (may_be_edge && straddles_edge(u + shift.x(), v + shift.y())) {
      return sensor_.edges == Edges::mix ? see_mixture(u + shift.x(), v + shift.y()) : std::nullopt;
    }
    const Pixel& own = scan_.pixels[i];
    if (!sensor_.kinect_noise) return see_ideal(own);
    const auto hit = trace(u + shift.x(), v + shift.y());
    if (!hit) return std::nullopt;
    return is_on_surface_of(own, *hit, shift) ? see_ideal(own) : see_hit(*hit);
  }

  /// True if a shifted ray hit the same surface as the pixel's own ray. Then the slope explains their
  /// difference in depth: on a plane it is at most the shift (as an angle) times 1 + tan(incidence) times the
  /// larger depth, and on a curved surface no more than where it is steeper.
  bool is_on_surface_of(const Pixel& own, const Hit& hit, const Vector2d& shift) const {
    if (own.label != hit.first.label) return false;
    const double own_depth = own.depth;
    const double angle = std::hypot(shift.x() / camera_.fx, shift.y() / camera_.fy);
    const double steepest = std::max<double>(own.incidence, incidence_of(hit.ray, hit.first.surface.normal));
    return std::abs(hit.depth - own_depth) <=
           angle * (1 + std::abs(std::tan(steepest))) * std::max(hit.depth, own_depth);
  }

  std::optional<Sight> see_ideal(const Pixel& pixel) {
    if (pixel.label == null_label) return std::nullopt;
    const Vector3d normal = pixel.normal.cast<double>();
    return Sight{pixel.depth,
                 normal,
                 pixel.incidence,
                 pixel.label,
                 snr_at(pixel.point.cast<double>(), normal, pixel.label),
                 false};
  }

  Sight see_hit(const Hit& hit) {
    const Vector3d& normal = hit.first.surface.normal;
    return {hit.depth, normal, incidence_of(hit.ray, normal), hit.first.label, snr_of(hit), false};
  }

  double snr_of(const Hit& hit) {
    const auto& [range, normal] = hit.first.surface;
    return snr_at(hit.ray.origin + range * hit.ray.direction, normal, hit.first.label);
  }

  double snr_at(const Vector3d& point, const Vector3d& normal, std::int32_t label) {
    const bool is_lit_evenly = !sensor_.shadows && !sensor_.signal;
    return is_lit_evenly ? 1 : illumination_.snr(point, normal, label);
  }

  std::optional<Hit> trace(double u, double v) {
    if (!candidates_are_found_) {
      index_->find(tile_left_, tile_top_, candidates_);
      candidates_are_found_ = true;
    }
    const Ray ray = ray_through(camera_, u, v);
    const auto first = first_hit(surfaces_, candidates_, ray);
    if (!first) return std::nullopt;
    return Hit{ray, first->surface.distance * optical_axis_.dot(ray.direction), *first};
  }

  /// Distance from a footprint's centre to its outermost sub-rays, in pixels.
  double outermost() const { return (sensor_.footprint - sensor_.footprint / sensor_.sub_rays) / 2; }

  /// True if the sub-rays in the corners of the footprint hit different surfaces.
  bool straddles_edge(double u, double v) {
    const double corner = outermost();
    double nearest = std::numeric_limits<double>::infinity();
    double farthest = -nearest;
    int hits = 0;
    for (const double du : {-corner, corner}) {
      for (const double dv : {-corner, corner}) {
        const auto hit = trace(u + du, v + dv);
        if (!hit) continue;
        ++hits;
        nearest = std::min(nearest, hit->depth);
        farthest = std::max(farthest, hit->depth);
      }
    }
    constexpr int corners = 4;
    return hits > 0 && (hits < corners || farthest - nearest > sensor_.edge_jump);
  }

  /// The surface of which the footprint's sub-rays see most, at the mean depth of all of them, weighted by
  /// signal. None if no signal returns.
  std::optional<Sight> see_mixture(double u, double v) {
    const int n = sensor_.sub_rays;
    const double step = sensor_.footprint / n;
    shares_.clear();
    double signal = 0;
    double weighted_depth = 0;
    for (int row = 0; row < n; ++row) {
      for (int column = 0; column < n; ++column) {
        const auto hit = trace(u - outermost() + column * step, v - outermost() + row * step);
        if (!hit) continue;
        const double snr = snr_of(*hit);
        signal += snr;
        weighted_depth += snr * hit->depth;
        add_to_shares(*hit, snr);
      }
    }
    if (!(signal > 0)) return std::nullopt;
    const Hit& most = largest_share().nearest;
    const Vector3d& normal = most.first.surface.normal;
    return Sight{weighted_depth / signal, normal,           incidence_of(most.ray, normal),
                 most.first.label,        signal / (n * n), true};
  }

  void add_to_shares(const Hit& hit, double signal) {
    const auto share = std::ranges::find(shares_, hit.first.label,
                                         [](const Share& other) { return other.nearest.first.label; });
    if (share == shares_.end()) {
      shares_.push_back({signal, hit});
      return;
    }
    share->signal += signal;
    if (hit.depth < share->nearest.depth) share->nearest = hit;
  }

  // Of two equal ones, the nearer.
  const Share& largest_share() const {
    return *std::ranges::max_element(
        shares_, {}, [](const Share& share) { return std::pair(share.signal, -share.nearest.depth); });
  }

  void record(int u, int v, std::size_t i, const Sight& sight) {
    const Ray ray = ray_through(camera_, u, v);
    const double axial_cosine = optical_axis_.dot(ray.direction);
    double range = sight.depth / axial_cosine;
    range += noise_.draw(number_of(u, v), i, sight.depth, sight.incidence, sight.snr, axial_cosine);
    if (!trueness_.empty()) range += trueness_[i];
    if (!(range > 0)) {
      scan_.pixels[i] = empty_pixel();
      return;
    }
    scan_.pixels[i] = {.depth = static_cast<float>(range * axial_cosine),
                       .range = static_cast<float>(range),
                       .point = (ray.origin + range * ray.direction).cast<float>(),
                       .normal = sight.normal.cast<float>(),
                       .incidence = static_cast<float>(sight.incidence),
                       .label = sight.label};
    scan_.snr[i] = static_cast<float>(sight.snr);
    scan_.mixed[i] = sight.mixed ? 1 : 0;
  }

  const Surfaces& surfaces_;
  Scan scan_;
  Camera camera_;
  const Sensor& sensor_;
  Vector3d optical_axis_;
  Illumination illumination_;
  RangeNoise noise_;
  CounterRandom dropout_;
  CounterRandom lateral_;
  std::vector<bool> near_edge_;
  std::vector<float> trueness_;
  std::optional<TileIndex> index_;

  int tile_left_ = 0;
  int tile_top_ = 0;
  bool candidates_are_found_ = false;
  Candidates candidates_;
  std::vector<Share> shares_;  // of the pixel that is being measured
};

}  // namespace

double ray_margin(const Sensor& sensor) {
  const double footprint = sensor.edges == Edges::keep ? 0 : sensor.footprint / 2;
  return footprint + (sensor.kinect_noise ? farthest_lateral_shift : 0);
}

Scan measure(const Surfaces& surfaces, Scan ideal, const Sensor& sensor, const ScanSeeds& seeds) {
  Scan measured = Measurement(surfaces, std::move(ideal), sensor, seeds).run();
  fill_gaps(measured, sensor.fill);
  if (sensor.quantization > 0) quantize(measured, sensor.quantization);
  return sensor.median > 0 ? median_filtered(measured, sensor.median) : measured;
}

}  // namespace tanglebin
