#include "tanglebin/model/axis/fragments/ramps.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

namespace tanglebin {
namespace {

/// The nearest point of each pixel of the image.
struct DepthGrid {
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  std::size_t width;
  std::size_t height;
  std::vector<float> depths;          // m, row by row; NaN where there is no point
  std::vector<std::uint32_t> points;  // none where there is none
};

DepthGrid depth_grid(const std::vector<Eigen::Vector3f>& points, const Camera& camera) {
  const auto width = static_cast<std::size_t>(camera.width);
  const auto height = static_cast<std::size_t>(camera.height);
  DepthGrid grid{width, height, std::vector(width * height, std::numeric_limits<float>::quiet_NaN()),
                 std::vector(width * height, DepthGrid::none)};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::optional<SeenPixel> seen = seen_pixel(camera, points[i].cast<double>());
    if (!seen) continue;
    const auto [column, row] = seen->pixel;
    const std::size_t pixel = static_cast<std::size_t>(row) * width + static_cast<std::size_t>(column);
    const auto depth = static_cast<float>(seen->depth);
    if (grid.depths[pixel] <= depth) continue;
    grid.depths[pixel] = depth;
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

/// A line of pixels: a row or a column.
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

  void look_along(const Line& line) {
    std::size_t begin = 0;
    int direction = 0;
    for (std::size_t i = 0; i < line.count; ++i) {
      const int next = i + 1 < line.count ? steep_step(line[i], line[i + 1]) : 0;
      if (next == direction) continue;
      if (direction != 0) add({line, begin, i, direction > 0});
      begin = i;
      direction = next;
    }
  }

  Ramps found(std::size_t points) const {
    Ramps ramps{std::vector<bool>(points), 0};
    if (edges_ > 0) ramps.blended = static_cast<double>(blended_) / static_cast<double>(edges_);
    for (const Run& run : runs_) mark(run, ramps.points);
    return ramps;
  }

private:
  float depth(const Run& run, std::size_t place) const { return grid_.depths[run.line[place]]; }

  double drop_of(const Run& run) const { return depth(run, run.far_end()) - depth(run, run.near_end()); }

  // Away from the camera: 1, towards it: −1, not steep or not known: 0.
  int steep_step(std::size_t from, std::size_t to) const {
    const float step = grid_.depths[to] - grid_.depths[from];
    const double width = pixel_angle_ * std::min(grid_.depths[from], grid_.depths[to]);
    if (!(std::abs(step) > settings_.slope_min * width)) return 0;
    return step > 0 ? 1 : -1;
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
    return grid_.points[run.line[behind]] == DepthGrid::none;
  }

  // A scanner that makes long ramps bends the surfaces beside them too.
  std::size_t reach_beside() const {
    if (ramps_ == 0) return 0;
    const double length = static_cast<double>(between_) / static_cast<double>(ramps_);
    return static_cast<std::size_t>(std::lround(settings_.beside * length));
  }

  void mark(const Run& run, std::vector<bool>& points) const {
    const std::size_t beside = reach_beside();
    const std::size_t first = run.begin + 1 > beside ? run.begin + 1 - beside : 0;
    const std::size_t last = std::min(run.end - 1 + beside, run.line.count - 1);
    for (std::size_t i = first; i <= last; ++i) mark(run.line[i], points);
    if (leads_nowhere(run)) mark(run.line[run.far_end()], points);
  }

  void mark(std::size_t pixel, std::vector<bool>& points) const {
    if (grid_.points[pixel] != DepthGrid::none) points[grid_.points[pixel]] = true;
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
  const DepthGrid grid = depth_grid(points, camera);
  const double pixel_angle = 1 / std::max(camera.fx, camera.fy);
  if (is_mostly_deeper(grid, thinnest / (settings.pixels_min * pixel_angle)))
    return {std::vector<bool>(points.size()), 0};
  RampFinder finder(grid, pixel_angle, thickest, settings);
  for (std::size_t row = 0; row < grid.height; ++row) finder.look_along({row * grid.width, 1, grid.width});
  for (std::size_t column = 0; column < grid.width; ++column)
    finder.look_along({column, grid.width, grid.height});
  return finder.found(points.size());
}

}  // namespace tanglebin
