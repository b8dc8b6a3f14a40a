#include "tanglebin/model/axis/fragments/ramps.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

namespace tanglebin {
namespace {

/// Where a point is seen.
struct ImagePoint {
  PixelPosition pixel{};
  float depth = std::numeric_limits<float>::quiet_NaN();  // m; NaN if it is not seen

  bool is_seen() const { return !std::isnan(depth); }
};

std::vector<ImagePoint> seen_by(const Camera& camera, const std::vector<Eigen::Vector3f>& points) {
  std::vector<ImagePoint> result(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::optional<SeenPixel> seen = seen_pixel(camera, points[i].cast<double>());
    if (!seen) continue;
    result[i] = {seen->pixel, static_cast<float>(seen->depth)};
  }
  return result;
}

/// The nearest point in each pixel, of the part of the image that has points.
struct DepthGrid {
  PixelPosition first{};  // of the image
  std::size_t width = 0;
  std::size_t height = 0;
  std::vector<float> depths{};          // m, row by row; NaN where there is no point
  std::vector<std::uint32_t> points{};  // their numbers in the cloud

  std::size_t pixel_of(const ImagePoint& point) const {
    return static_cast<std::size_t>(point.pixel.row - first.row) * width +
           static_cast<std::size_t>(point.pixel.column - first.column);
  }
};

DepthGrid depth_grid(const std::vector<ImagePoint>& points) {
  Eigen::AlignedBox2i part;
  for (const ImagePoint& point : points) {
    if (point.is_seen()) part.extend(Eigen::Vector2i(point.pixel.column, point.pixel.row));
  }
  if (part.isEmpty()) return {};
  const Eigen::Matrix<std::size_t, 2, 1> size = (part.sizes() + Eigen::Vector2i::Ones()).cast<std::size_t>();
  DepthGrid grid{{part.min().x(), part.min().y()}, size.x(), size.y()};
  grid.depths.assign(grid.width * grid.height, std::numeric_limits<float>::quiet_NaN());
  grid.points.resize(grid.width * grid.height);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].is_seen()) continue;
    const std::size_t pixel = grid.pixel_of(points[i]);
    if (grid.depths[pixel] <= points[i].depth) continue;
    grid.depths[pixel] = points[i].depth;
    grid.points[pixel] = static_cast<std::uint32_t>(i);
  }
  return grid;
}

// Whether half of the points or more are deeper than this, m.
bool is_mostly_deeper(const DepthGrid& grid, double depth) {
  const auto all = std::ranges::count_if(grid.depths, [](float seen) { return !std::isnan(seen); });
  const auto deeper = std::ranges::count_if(grid.depths, [&](float seen) { return seen > depth; });
  return 2 * deeper >= all;
}

/// Pixels one behind the other: of a row or a column.
struct Line {
  std::size_t first;
  std::size_t stride;
  std::size_t count;

  std::size_t operator[](std::size_t place) const { return first + place * stride; }
};

/// Places on a line, both included, with a steep step from each to the next.
struct Run {
  Line line;
  std::size_t begin;
  std::size_t end;
  bool leads_down;  ///< away from the camera

  std::size_t near_end() const { return leads_down ? begin : end; }
  std::size_t far_end() const { return leads_down ? end : begin; }
  std::size_t steps() const { return end - begin; }
};

class RampFinder {
public:
  RampFinder(const DepthGrid& grid, double pixel_angle, double radius, const RampSettings& settings)
      : grid_(grid), pixel_angle_(pixel_angle), radius_(radius), settings_(settings) {}

  void look_along_rows() {
    look_along({1, grid_.width}, [&](std::size_t pixel) { return pixel % grid_.width; });
  }
  void look_along_columns() {
    look_along({grid_.width, grid_.height}, [&](std::size_t pixel) { return pixel / grid_.width; });
  }

  // Among this many points.
  Ramps found(std::size_t points) const {
    Ramps ramps{std::vector<bool>(points), 0, {}};
    if (edges_ > 0) ramps.blended = static_cast<double>(blended_) / static_cast<double>(edges_);
    for (const Run& run : runs_) mark(run, ramps.points);
    for (const auto& [pixel, end] : nearest_ends())
      ramps.between.push_back({grid_.points[pixel], grid_.points[end]});
    return ramps;
  }

private:
  /// All rows or all columns.
  struct Lines {
    std::size_t stride;  // from a pixel to the next
    std::size_t count;   // of a line's pixels
  };

  float depth(const Run& run, std::size_t place) const { return grid_.depths[run.line[place]]; }

  double drop_of(const Run& run) const { return depth(run, run.far_end()) - depth(run, run.near_end()); }

  /// How the surface goes on from each pixel to the next of its line: away from the camera 1, towards it −1;
  /// 0 if that is not steep or not known.
  struct Steps {
    std::vector<std::int8_t> of_pixels;
    std::vector<std::size_t> steep;  // pixels, ascending
  };

  Steps steps_along(const Lines& lines, const auto& place_on_line) const {
    const std::size_t stride = lines.stride;
    const std::vector<float>& depths = grid_.depths;
    Steps steps{std::vector<std::int8_t>(depths.size()), {}};
    // Most steps are not steep by far, which single precision shows fast.
    constexpr double surely = 0.999;
    const auto slope = static_cast<float>(surely * settings_.slope_min * pixel_angle_);
    for (std::size_t i = 0; i + stride < depths.size(); ++i) {
      const float from = depths[i];
      const float to = depths[i + stride];
      steps.of_pixels[i] = std::abs(to - from) > slope * std::min(from, to) ? 1 : 0;
    }
    for (std::size_t i = 0; i < depths.size(); ++i) {
      if (steps.of_pixels[i] == 0) continue;
      const bool is_last = place_on_line(i) + 1 == lines.count;
      steps.of_pixels[i] = is_last ? std::int8_t{0} : steep_step(i, i + stride);
      if (steps.of_pixels[i] != 0) steps.steep.push_back(i);
    }
    return steps;
  }

  std::int8_t steep_step(std::size_t from, std::size_t to) const {
    const float step = grid_.depths[to] - grid_.depths[from];
    const double width = pixel_angle_ * std::min(grid_.depths[from], grid_.depths[to]);
    if (!(std::abs(step) > settings_.slope_min * width)) return 0;
    return step > 0 ? 1 : -1;
  }

  // A run begins where the step before is another one.
  void look_along(const Lines& lines, const auto& place_on_line) {
    const std::size_t stride = lines.stride;
    const auto& [steps, steep] = steps_along(lines, place_on_line);
    for (const std::size_t pixel : steep) {
      const std::int8_t step = steps[pixel];
      if (pixel >= stride && steps[pixel - stride] == step) continue;
      const std::size_t begin = place_on_line(pixel);
      std::size_t end = begin;
      for (std::size_t i = pixel; steps[i] == step; i += stride) ++end;
      add({{pixel - begin * stride, stride, lines.count}, begin, end, step > 0});
    }
  }

  void add(const Run& run) {
    const double drop = drop_of(run);
    const bool is_edge = drop >= settings_.edge_min * radius_;
    if (is_edge) ++edges_;
    if (drop < settings_.drop_min * radius_ || run.steps() > static_cast<std::size_t>(settings_.steps_max))
      return;
    if (is_edge && has_middle(run, drop)) ++blended_;
    if (is_edge && run.steps() > 1 && !leads_nowhere(run)) {
      ++ramps_;
      between_ += run.steps() - 1;
    }
    runs_.push_back(run);
  }

  bool has_middle(const Run& run, double drop) const {
    constexpr double quarter = 0.25;
    const double near = depth(run, run.near_end());
    for (std::size_t i = run.begin + 1; i < run.end; ++i) {
      const double share = (depth(run, i) - near) / drop;
      if (share > quarter && share < 1 - quarter) return true;
    }
    return false;
  }

  // Behind the far end nothing was measured, so the far end is no surface.
  bool leads_nowhere(const Run& run) const {
    if (run.far_end() == (run.leads_down ? run.line.count - 1 : 0)) return true;
    const std::size_t behind = run.leads_down ? run.far_end() + 1 : run.far_end() - 1;
    return std::isnan(depth(run, behind));
  }

  // A scanner that makes long ramps bends the surfaces beside them too.
  std::size_t reach_beside() const {
    if (ramps_ == 0) return 0;
    const double length = static_cast<double>(between_) / static_cast<double>(ramps_);
    return static_cast<std::size_t>(std::lround(settings_.beside * length));
  }

  // The places, both included, that a run bends.
  std::pair<std::size_t, std::size_t> bent_by(const Run& run) const {
    const std::size_t beside = reach_beside();
    const std::size_t first = run.begin + 1 > beside ? run.begin + 1 - beside : 0;
    return {first, std::min(run.end - 1 + beside, run.line.count - 1)};
  }

  void mark(const Run& run, std::vector<bool>& points) const {
    const auto mark_at = [&](std::size_t place) {
      const std::size_t pixel = run.line[place];
      if (!std::isnan(grid_.depths[pixel])) points[grid_.points[pixel]] = true;
    };
    const auto [first, last] = bent_by(run);
    for (std::size_t place = first; place <= last; ++place) mark_at(place);
    if (leads_nowhere(run)) mark_at(run.far_end());
  }

  /// A pixel on a ramp, and one at an end of it.
  struct PixelAndEnd {
    std::size_t pixel;
    std::size_t end;
  };

  // The ends of a ramp are the first places on either side that it does not bend, if they are seen.
  void find_ends(const Run& run, std::vector<PixelAndEnd>& ends) const {
    const auto [first, last] = bent_by(run);
    const auto is_seen = [&](std::size_t place) { return !std::isnan(depth(run, place)); };
    const std::size_t before = first > 0 && is_seen(first - 1) ? first - 1 : run.begin;
    const std::size_t after = last + 1 < run.line.count && is_seen(last + 1) ? last + 1 : run.end;
    for (std::size_t place = first; place <= last; ++place) {
      if (place == before || place == after || !is_seen(place)) continue;
      ends.push_back({run.line[place], run.line[before]});
      ends.push_back({run.line[place], run.line[after]});
    }
  }

  // For each pixel that is on a ramp or more, the end that is nearest in depth.
  std::vector<PixelAndEnd> nearest_ends() const {
    std::vector<PixelAndEnd> ends;
    for (const Run& run : runs_) {
      if (!leads_nowhere(run)) find_ends(run, ends);
    }
    const auto away = [&](const PixelAndEnd& end) {
      return std::abs(grid_.depths[end.end] - grid_.depths[end.pixel]);
    };
    std::ranges::stable_sort(ends, {},
                             [&](const PixelAndEnd& end) { return std::pair(end.pixel, away(end)); });
    const auto are_of_one_pixel = [](const PixelAndEnd& a, const PixelAndEnd& b) {
      return a.pixel == b.pixel;
    };
    ends.erase(std::unique(ends.begin(), ends.end(), are_of_one_pixel), ends.end());
    return ends;
  }

  const DepthGrid& grid_;
  double pixel_angle_;  // rad
  double radius_;       // m
  const RampSettings& settings_;
  std::vector<Run> runs_;
  std::size_t edges_ = 0;
  std::size_t blended_ = 0;  // edges
  std::size_t ramps_ = 0;    // from a surface to another
  std::size_t between_ = 0;  // points on these
};

}  // namespace

Ramps find_ramps(const std::vector<Eigen::Vector3f>& points, const Camera& camera, double thinnest,
                 double thickest, const RampSettings& settings) {
  const std::vector<ImagePoint> seen = seen_by(camera, points);
  const DepthGrid grid = depth_grid(seen);
  const double pixel_angle = 1 / std::max(camera.fx, camera.fy);
  if (is_mostly_deeper(grid, thinnest / (settings.pixels_min * pixel_angle)))
    return {std::vector<bool>(points.size()), 0, {}};
  RampFinder finder(grid, pixel_angle, thickest, settings);
  finder.look_along_rows();
  finder.look_along_columns();
  return finder.found(points.size());
}

}  // namespace tanglebin
