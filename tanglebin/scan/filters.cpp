#include "tanglebin/scan/filters.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "tanglebin/geometry/camera.hpp"

namespace tanglebin {
namespace {

constexpr std::size_t lost = static_cast<std::size_t>(-1);

/// Finds the median of a window.
class Window {
public:
  Window(const Scan& scan, int size) : scan_(scan), reach_(size / 2), middle_(cells(size) / 2) {
    depths_.reserve(cells(size));
  }

  /// The place of the measurement that has the median depth around a pixel; `lost` if most are lost. Of equal
  /// depths, the pixel's own comes first, then those above and to the left.
  std::size_t median_around(int u, int v) {
    const PixelWindow& window = scan_.window;
    const std::size_t own = scan_.index(u, v);
    depths_.clear();
    for (int row = std::max(v - reach_, window.top);
         row <= std::min(v + reach_, window.top + window.height - 1); ++row) {
      for (int column = std::max(u - reach_, window.left);
           column <= std::min(u + reach_, window.left + window.width - 1); ++column) {
        const std::size_t place = scan_.index(column, row);
        const float depth = scan_.pixels[place].depth;
        if (!std::isnan(depth)) depths_.emplace_back(depth, place);
      }
    }
    if (depths_.size() <= middle_) return lost;
    const auto middle = depths_.begin() + static_cast<std::ptrdiff_t>(middle_);
    std::nth_element(depths_.begin(), middle, depths_.end());
    return middle->first == scan_.pixels[own].depth ? own : middle->second;
  }

private:
  static std::size_t cells(int size) {
    return static_cast<std::size_t>(size) * static_cast<std::size_t>(size);
  }

  const Scan& scan_;
  int reach_;
  std::size_t middle_;
  std::vector<std::pair<float, std::size_t>> depths_;
};

/// Moves a pixel along its ray to another depth.
void move_to_depth(Scan& scan, int u, int v, double depth) {
  const Ray ray = ray_through(scan.camera, u, v);
  const double range = depth / scan.camera.pose.linear().col(2).dot(ray.direction);
  Pixel& pixel = scan.at(u, v);
  pixel.depth = static_cast<float>(depth);
  pixel.range = static_cast<float>(range);
  pixel.point = (ray.origin + range * ray.direction).cast<float>();
}

void lose(Scan& scan, int u, int v) {
  const std::size_t place = scan.index(u, v);
  scan.pixels[place] = empty_pixel();
  scan.snr[place] = 0;
  scan.mixed[place] = 0;
}

bool is_measured(const Pixel& pixel) {
  return !std::isnan(pixel.depth);
}

// Between the measured pixels in columns `first` and `last` of a row.
void fill_gap(Scan& scan, int first, int last, int row) {
  const std::size_t start = scan.index(first, row);
  const std::size_t end = scan.index(last, row);
  const double from = scan.pixels[start].depth;
  const double to = scan.pixels[end].depth;
  const std::size_t nearer = to < from ? end : start;
  for (int column = first + 1; column < last; ++column) {
    const std::size_t place = scan.index(column, row);
    const double share = static_cast<double>(column - first) / (last - first);
    scan.pixels[place] = scan.pixels[nearer];
    scan.snr[place] = scan.snr[nearer];
    scan.mixed[place] = 1;
    move_to_depth(scan, column, row, from + share * (to - from));
  }
}

}  // namespace

void fill_gaps(Scan& scan, int longest) {
  const PixelWindow& window = scan.window;
  for (int row = window.top; row < window.top + window.height; ++row) {
    std::optional<int> last_measured;
    for (int column = window.left; column < window.left + window.width; ++column) {
      if (!is_measured(scan.at(column, row))) continue;
      const int gap = last_measured ? column - *last_measured - 1 : 0;
      if (gap > 0 && gap <= longest) fill_gap(scan, *last_measured, column, row);
      last_measured = column;
    }
  }
}

void quantize(Scan& scan, double step) {
  const PixelWindow& window = scan.window;
  for (int v = window.top; v < window.top + window.height; ++v) {
    for (int u = window.left; u < window.left + window.width; ++u) {
      if (!is_measured(scan.at(u, v))) continue;
      const double depth = std::round(scan.at(u, v).depth / step) * step;
      if (depth > 0) {
        move_to_depth(scan, u, v, depth);
      } else {
        lose(scan, u, v);
      }
    }
  }
}

Scan median_filtered(const Scan& scan, int size) {
  Scan filtered = scan;
  Window window(scan, size);
  for (int v = scan.window.top; v < scan.window.top + scan.window.height; ++v) {
    for (int u = scan.window.left; u < scan.window.left + scan.window.width; ++u) {
      const std::size_t own = scan.index(u, v);
      const std::size_t median = window.median_around(u, v);
      if (median == own) continue;
      Pixel& pixel = filtered.pixels[own];
      if (median == lost) {
        lose(filtered, u, v);
        continue;
      }
      const Pixel& donor = scan.pixels[median];
      const bool is_of_another = !is_measured(pixel) || donor.label != pixel.label;
      if (is_of_another) {
        pixel = donor;
        filtered.snr[own] = scan.snr[median];
      }
      if (is_of_another || scan.mixed[median] != 0) filtered.mixed[own] = 1;
      move_to_depth(filtered, u, v, donor.depth);
    }
  }
  return filtered;
}

}  // namespace tanglebin
