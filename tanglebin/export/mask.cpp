#include "tanglebin/export/mask.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "tanglebin/geometry/labels.hpp"

namespace tanglebin {
namespace {

/// A pixel's edge as a step from corner to corner, with the pixel on its right.
enum class Step { right, down, left, up };
constexpr std::array<Step, 4> steps{Step::right, Step::down, Step::left, Step::up};

struct Corner {
  int x;
  int y;

  bool operator==(const Corner&) const = default;
};

Step turned_right(Step step) {
  return steps.at((static_cast<std::size_t>(step) + 1) % steps.size());
}

Step turned_left(Step step) {
  return steps.at((static_cast<std::size_t>(step) + 3) % steps.size());
}

Corner after(const Corner& corner, Step step) {
  switch (step) {
    case Step::right:
      return {corner.x + 1, corner.y};
    case Step::down:
      return {corner.x, corner.y + 1};
    case Step::left:
      return {corner.x - 1, corner.y};
    case Step::up:
      return {corner.x, corner.y - 1};
  }
  return corner;
}

// The pixels on either side of a step, by their upper left corners.
Corner pixel_right_of(const Corner& corner, Step step) {
  switch (step) {
    case Step::right:
      return corner;
    case Step::down:
      return {corner.x - 1, corner.y};
    case Step::left:
      return {corner.x - 1, corner.y - 1};
    case Step::up:
      return {corner.x, corner.y - 1};
  }
  return corner;
}

Corner pixel_left_of(const Corner& corner, Step step) {
  return pixel_right_of(after(corner, step), turned_right(turned_right(step)));
}

/// Traces the outlines of a mask's parts.
class Outlines {
public:
  explicit Outlines(const Mask& mask) : mask_(mask), box_(box_of(mask)) {
    const auto [left, top, width, height] = box_;
    part_of_.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), outside);
    for (const std::uint32_t pixel : mask.pixels) part_at(pixel_of(pixel)) = unknown;
    is_traced_.resize(part_of_.size());
  }

  std::vector<Polygon> trace() {
    std::vector<Polygon> result;
    for (const std::uint32_t number : mask_.pixels) {
      const Corner pixel = pixel_of(number);
      if (part_at(pixel) == unknown) {
        fill(pixel, static_cast<int>(result.size()));
        result.emplace_back();
      }
      // Every outline, that of a hole too, has a step to the right.
      trace_from(pixel, result[static_cast<std::size_t>(part_at(pixel))]);
    }
    return result;
  }

private:
  static constexpr int outside = -1;
  static constexpr int unknown = -2;

  Corner pixel_of(std::uint32_t number) const {
    const auto width = static_cast<std::uint32_t>(mask_.width);
    return {static_cast<int>(number % width), static_cast<int>(number / width)};
  }

  std::size_t index_of(const Corner& pixel) const {
    const auto [left, top, width, height] = box_;
    return static_cast<std::size_t>(pixel.y - top) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(pixel.x - left);
  }

  bool is_in_box(const Corner& pixel) const {
    const auto [left, top, width, height] = box_;
    return pixel.x >= left && pixel.y >= top && pixel.x < left + width && pixel.y < top + height;
  }

  int& part_at(const Corner& pixel) { return part_of_[index_of(pixel)]; }
  bool is_inside(const Corner& pixel) { return is_in_box(pixel) && part_at(pixel) != outside; }

  // Gives all pixels that are connected with this one their part's number.
  void fill(const Corner& first, int part) {
    std::vector<Corner> to_do{first};
    part_at(first) = part;
    while (!to_do.empty()) {
      const Corner pixel = to_do.back();
      to_do.pop_back();
      for (const Step step : steps) {
        const Corner next = after(pixel, step);
        if (!is_inside(next) || part_at(next) != unknown) continue;
        part_at(next) = part;
        to_do.push_back(next);
      }
    }
  }

  bool is_edge(const Corner& corner, Step step) {
    return is_inside(pixel_right_of(corner, step)) && !is_inside(pixel_left_of(corner, step));
  }

  // Appends the outline that begins with a step to the right to its part's polygon, unless it is traced
  // already.
  void trace_from(const Corner& start, Polygon& polygon) {
    if (!is_edge(start, Step::right) || is_traced_[index_of(start)]) return;
    const Polygon outline = corners_from(start);
    if (polygon.empty()) {
      polygon = outline;
      return;
    }
    // To the hole along a row and a column, around it, and back on the same way.
    const Corner home{polygon[0], polygon[1]};
    const Corner hole{outline[0], outline[1]};
    const auto add = [&](const Corner& corner) {
      polygon.push_back(corner.x);
      polygon.push_back(corner.y);
    };
    add(home);
    add({hole.x, home.y});
    polygon.insert(polygon.end(), outline.begin(), outline.end());
    add(hole);
    add({hole.x, home.y});
  }

  // At a corner where two pixels of the mask meet diagonally, the right turn stays with the same pixel.
  Polygon corners_from(const Corner& start) {
    Polygon corners;
    Corner corner = start;
    Step step = Step::right;
    do {
      if (step == Step::right) is_traced_[index_of(corner)] = true;
      corner = after(corner, step);
      const Step before = step;
      step = turned_right(before);
      while (!is_edge(corner, step)) step = turned_left(step);
      if (step != before) {
        corners.push_back(corner.x);
        corners.push_back(corner.y);
      }
    } while (!(corner == start && step == Step::right));
    return corners;
  }

  const Mask& mask_;
  std::array<int, 4> box_;
  std::vector<int> part_of_;     ///< of the pixels in the box
  std::vector<bool> is_traced_;  ///< the upper edges of these pixels
};

}  // namespace

std::vector<Mask> measured_masks(const Scan& scan, std::size_t tubes) {
  std::vector<Mask> masks(tubes, Mask{scan.camera.width, scan.camera.height, {}});
  const PixelWindow& window = scan.window;
  for (int v = window.top; v < window.top + window.height; ++v) {
    for (int u = window.left; u < window.left + window.width; ++u) {
      const std::int32_t label = scan.at(u, v).label;
      if (label <= bin_label) continue;
      masks.at(static_cast<std::size_t>(label - 1))
          .pixels.push_back(static_cast<std::uint32_t>(v) * static_cast<std::uint32_t>(scan.camera.width) +
                            static_cast<std::uint32_t>(u));
    }
  }
  return masks;
}

Mask whole_mask(const WholeView& view, const Camera& camera) {
  return {camera.width, camera.height, view.pixels};
}

std::array<int, 4> box_of(const Mask& mask) {
  if (mask.pixels.empty()) return {0, 0, 0, 0};
  const auto width = static_cast<std::uint32_t>(mask.width);
  std::uint32_t left = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t right = 0;
  for (const std::uint32_t pixel : mask.pixels) {
    left = std::min(left, pixel % width);
    right = std::max(right, pixel % width);
  }
  const std::uint32_t top = mask.pixels.front() / width;
  const std::uint32_t bottom = mask.pixels.back() / width;
  return {static_cast<int>(left), static_cast<int>(top), static_cast<int>(right - left + 1),
          static_cast<int>(bottom - top + 1)};
}

std::vector<std::uint32_t> run_lengths(const Mask& mask) {
  const auto width = static_cast<std::uint32_t>(mask.width);
  const auto height = static_cast<std::uint32_t>(mask.height);
  std::vector<std::uint32_t> by_column;
  by_column.reserve(mask.pixels.size());
  for (const std::uint32_t pixel : mask.pixels) by_column.push_back(pixel % width * height + pixel / width);
  std::ranges::sort(by_column);
  std::vector<std::uint32_t> lengths;
  std::uint32_t end = 0;  // of the last run inside
  for (const std::uint32_t pixel : by_column) {
    if (lengths.empty() || pixel != end) {
      lengths.push_back(pixel - end);
      lengths.push_back(0);
    }
    ++lengths.back();
    end = pixel + 1;
  }
  if (end < width * height || lengths.empty()) lengths.push_back(width * height - end);
  return lengths;
}

std::string compressed(const std::vector<std::uint32_t>& run_lengths) {
  std::string text;
  for (std::size_t i = 0; i < run_lengths.size(); ++i) {
    std::int64_t number = run_lengths[i];
    if (i > 2) number -= run_lengths[i - 2];
    bool goes_on = true;
    while (goes_on) {
      const auto bits = static_cast<unsigned>(number & 0x1f);
      number >>= 5;
      const bool is_negative = (bits & 0x10U) != 0;
      goes_on = number != (is_negative ? -1 : 0);
      text += static_cast<char>((bits | (goes_on ? 0x20U : 0U)) + 48U);
    }
  }
  return text;
}

std::vector<Polygon> polygons(const Mask& mask) {
  if (mask.pixels.empty()) return {};
  return Outlines(mask).trace();
}

}  // namespace tanglebin
