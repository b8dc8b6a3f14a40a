#include "tanglebin/model/axis/radius.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/median.hpp"
#include "tanglebin/base/picked.hpp"
#include "tanglebin/model/axis/cylinder_fit.hpp"
#include "tanglebin/model/axis/fragments/voxel.hpp"
#include "tanglebin/model/scene/filter.hpp"
#include "tanglebin/model/scene/known_scene.hpp"
#include "tanglebin/model/scene/support_frame.hpp"

namespace tanglebin {
namespace {

std::string millimetres(double metres) {
  const double value = 1e3 * metres;
  constexpr double two_digits = 99.5;  // above, {:.2g} writes 1e+02
  return value < two_digits ? fmt::format("{:.2g} mm", value) : fmt::format("{:.0f} mm", value);
}

// Tubes that are not looked for leave something else that seems to have a radius.
[[noreturn]] void give_up(const RadiusRange& range, const std::string& reason) {
  throw InputError({"", 0, "radius"},
                   fmt::format("{}; radii of {} to {} were looked for: give the radius, or another range, "
                               "radius = {{ min, max }} in [[tube]]",
                               reason, millimetres(range.min), millimetres(range.max)));
}

void validate(const RadiusRange& range) {
  if (!(range.min >= thinnest_radius && range.min < range.max && range.max <= thickest_radius))
    throw InputError({"", 0, "radius"}, fmt::format("{} to {} m", range.min, range.max),
                     fmt::format("a range within {} to {} m", thinnest_radius, thickest_radius));
}

/// A radius seen at a place.
struct Sighting {
  std::size_t item;  // of the grid
  double radius;     // m
};

// Every point of the grid once, in an order in which any first part is from all over it.
class Everywhere {
public:
  explicit Everywhere(std::size_t size) : size_(size) {}

  std::size_t size() const { return size_; }
  std::size_t operator[](std::size_t i) const {
    double whole = 0;
    return static_cast<std::size_t>(std::modf(static_cast<double>(i) * std::numbers::phi, &whole) *
                                    static_cast<double>(size_));
  }

private:
  std::size_t size_;
};

constexpr std::size_t looked_at = 5000;  // places at most
constexpr double error_max = 0.1;        // of the radius

std::optional<Sighting> sighting(const PixelGrid& grid, std::size_t item, double reach,
                                 double deviation_max) {
  const std::optional<CylinderFit> fit = fit_cylinder(grid, item, reach);
  if (!fit || fit->error > error_max * fit->radius) return std::nullopt;
  if (std::abs(std::log(fit->radius / reach)) > deviation_max) return std::nullopt;
  return Sighting{item, fit->radius};
}

// With all reaches in the range. A cylinder shows the same radius with every reach that suits it; an edge
// shows another one with each.
std::vector<Sighting> search(const PixelGrid& grid, const RadiusRange& range,
                             const std::function<void()>& at_place) {
  constexpr double step = 1.25;
  constexpr std::size_t enough = 500;
  const double deviation_max = std::log(step);
  std::vector<double> reaches;
  while (reaches.empty() || reaches.back() * step < range.max * std::sqrt(step))
    reaches.push_back(reaches.empty() ? range.min * std::sqrt(step) : reaches.back() * step);
  const Everywhere places(grid.size());
  std::vector<Sighting> sightings;
  for (std::size_t i = 0; i < std::min(looked_at, places.size()) && sightings.size() < enough; ++i) {
    at_place();
    for (const double reach : reaches) {
      const auto found = sighting(grid, places[i], reach, deviation_max);
      if (found) sightings.push_back(*found);
    }
  }
  return sightings;
}

/// How often radii were seen: a histogram over their logarithms, smoothed.
class Histogram {
public:
  explicit Histogram(const std::vector<Sighting>& sightings) {
    std::vector<double> logs;
    logs.reserve(sightings.size());
    for (const Sighting& seen : sightings) logs.push_back(std::log(seen.radius));
    const auto [least, most] = std::ranges::minmax(logs);
    constexpr std::size_t reach = 2;
    start_ = least - reach * width;
    counts_.resize(bin_of(most) + reach + 1);
    for (const double value : logs) {
      const std::size_t middle = bin_of(value);
      for (std::size_t bin = middle - reach; bin <= middle + reach; ++bin)
        counts_[bin] += static_cast<double>(1 + reach - std::max(bin, middle) + std::min(bin, middle));
    }
  }

  double radius(std::size_t bin) const { return std::exp(start_ + static_cast<double>(bin) * width); }

  std::size_t highest() const {
    return static_cast<std::size_t>(std::ranges::max_element(counts_) - counts_.begin());
  }

  // Whether one radius was seen more often than all of them by chance: on planes, noise shows any.
  bool has_a_peak() const {
    constexpr double share = 0.04;  // of all that was seen
    return counts_[highest()] > share * std::accumulate(counts_.begin(), counts_.end(), 0.0);
  }

  // The highest other peak, if it is high enough and there is a valley between the two.
  std::optional<std::size_t> other_peak() const {
    constexpr double share = 0.3;   // of the highest
    constexpr double valley = 0.5;  // of the other peak
    const std::size_t highest_bin = highest();
    std::optional<std::size_t> other;
    for (const int direction : {-1, 1}) {
      double lowest = counts_[highest_bin];
      for (std::size_t bin = highest_bin; bin < counts_.size(); bin += static_cast<std::size_t>(direction)) {
        lowest = std::min(lowest, counts_[bin]);
        if (counts_[bin] < share * counts_[highest_bin] || lowest > valley * counts_[bin]) continue;
        if (!other || counts_[bin] > counts_[*other]) other = bin;
      }
    }
    return other;
  }

private:
  std::size_t bin_of(double value) const {
    return static_cast<std::size_t>(std::lround((value - start_) / width));
  }

  static constexpr double width = 0.04;
  double start_;
  std::vector<double> counts_;
};

constexpr std::size_t sightings_min = 12;
constexpr std::size_t places_min = 3;

[[noreturn]] void give_up_without_tubes(const PixelGrid& grid, const RadiusRange& range) {
  constexpr std::size_t points_min = 200;
  if (grid.size() < points_min)
    give_up(range,
            fmt::format("the cloud shows too little of a tube to estimate it: {} points that may be on one",
                        grid.size()));
  constexpr double pixels_min = 5;
  const double pixels = grid.pixels_across(1, grid.point(Everywhere(grid.size())[1]));
  give_up(
      range,
      fmt::format("the cloud shows too little of a tube of {} to {} radius to estimate it (below {}, a tube "
                  "is less than {} pixels across)",
                  millimetres(range.min), millimetres(range.max), millimetres(pixels_min / 2 / pixels),
                  pixels_min));
}

std::size_t separate_places(const PixelGrid& grid, const std::vector<Sighting>& sightings, double distance) {
  std::set<std::uint64_t> voxels;
  for (const Sighting& seen : sightings)
    voxels.insert(voxel_key(voxel_at(grid.point(seen.item).cast<double>(), distance)));
  return voxels.size();
}

// Around this radius only.
std::vector<Sighting> look_closely(const PixelGrid& grid, double radius,
                                   const std::function<void()>& at_place) {
  constexpr double deviation_max = 0.25;
  constexpr std::size_t enough = 800;
  const Everywhere places(grid.size());
  std::vector<Sighting> sightings;
  for (std::size_t i = 0; i < std::min(looked_at, places.size()) && sightings.size() < enough; ++i) {
    at_place();
    const auto found = sighting(grid, places[i], radius, deviation_max);
    if (found) sightings.push_back(*found);
  }
  return sightings;
}

std::vector<double> radii_of(const std::vector<Sighting>& sightings) {
  std::vector<double> radii;
  radii.reserve(sightings.size());
  for (const Sighting& seen : sightings) radii.push_back(seen.radius);
  return radii;
}

RadiusEstimate refined(const PixelGrid& grid, double radius, const RadiusRange& range,
                       const std::function<void()>& at_place) {
  constexpr int rounds_max = 10;
  constexpr double settled = 0.002;
  constexpr double uncertain = 0.04;
  for (int round = 1;; ++round) {
    const std::vector<Sighting> sightings = look_closely(grid, radius, at_place);
    const std::size_t places = separate_places(grid, sightings, 2 * radius);
    if (sightings.size() < sightings_min || places < places_min) give_up_without_tubes(grid, range);
    const double next = median(radii_of(sightings));
    const double scatter = deviation_about(next, radii_of(sightings));
    const double of_median = std::sqrt(std::numbers::pi / 2);  // against the mean
    const double standard_error = of_median * scatter / std::sqrt(static_cast<double>(places));
    if (std::abs(next - radius) <= std::max(settled * next, standard_error)) {
      if (standard_error > uncertain * next)
        give_up(range, fmt::format("the radius is uncertain, {} ± {}", millimetres(next),
                                   millimetres(standard_error)));
      return {next, standard_error, scatter, round, places};
    }
    if (round == rounds_max)
      give_up(range, fmt::format("the estimate does not settle, at {} or {}", millimetres(radius),
                                 millimetres(next)));
    radius = next;
  }
}

}  // namespace

RadiusEstimate estimate_radius(const PointCloud& cloud, const KnownScene& known, const RadiusRange& range,
                               const std::function<void()>& at_place) {
  validate(range);
  const Seen seen = in_support_frame(cloud, known);
  const PixelGrid grid(picked(seen.cloud.points, crop(seen.cloud, seen.known.support, {}).kept),
                       seen.known.camera);
  const std::vector<Sighting> sightings = search(grid, range, at_place);
  if (sightings.size() < sightings_min) give_up_without_tubes(grid, range);
  const Histogram histogram(sightings);
  if (!histogram.has_a_peak())
    give_up(range, "no radius stands out in the cloud: the sensor may be too noisy for these tubes");
  const double radius = histogram.radius(histogram.highest());
  if (const auto other = histogram.other_peak()) {
    const auto [thin, thick] = std::minmax({radius, histogram.radius(*other)});
    give_up(range, fmt::format("the cloud shows tubes of several radii, of about {} and {}",
                               millimetres(thin), millimetres(thick)));
  }
  return refined(grid, radius, range, at_place);
}

}  // namespace tanglebin
