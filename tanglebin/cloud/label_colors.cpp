#include "tanglebin/cloud/label_colors.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "tanglebin/base/error.hpp"
#include "tanglebin/geometry/labels.hpp"

namespace tanglebin {
namespace {

constexpr int most_tubes = 1'000'000;
constexpr int most_tubes_of_scenes = 1000;  // a recipe's limit
constexpr Color bin_color{128, 128, 128};

// Vivid, and neither dark nor pale, to stand out from the bin's grey and from black; there is room for
// millions. In a grid search, these bounds and first hue kept the first twenty colours farthest apart in
// CIELAB (ΔE of the nearest two: 21).
constexpr double first_hue = 0.35;
constexpr double least_saturation = 0.6;
constexpr double most_saturation = 0.9;
constexpr double least_value = 0.55;
constexpr double most_value = 1.0;

constexpr double golden_ratio = 1.6180339887498949;

std::uint32_t packed(const Color& color) {
  return std::uint32_t{color[0]} << 16 | std::uint32_t{color[1]} << 8 | std::uint32_t{color[2]};
}

double fraction(double x) {
  return x - std::floor(x);
}

// Plain arithmetic, unlike std::lerp, so that every standard library gives the same result.
double between(double low, double high, double t) {
  return low + t * (high - low);
}

// The van der Corput sequence: the digits of i, mirrored at the radix point (Niederreiter 1992,
// Definition 3.1).
double van_der_corput(unsigned i, unsigned base) {
  double result = 0.0;
  double digit_value = 1.0;
  for (; i > 0; i /= base) {
    digit_value /= base;
    result += digit_value * (i % base);
  }
  return result;
}

std::uint8_t to_byte(double unit) {
  return static_cast<std::uint8_t>(std::lround(255.0 * unit));
}

// Hue, saturation and value in [0, 1] (Smith 1978, "Color gamut transform pairs", the hexcone model).
Color from_hsv(double hue, double saturation, double value) {
  const auto channel = [&](double offset) {
    const double k = std::fmod(offset + 6.0 * hue, 6.0);
    return to_byte(value - value * saturation * std::clamp(std::min(k, 4.0 - k), 0.0, 1.0));
  };
  return {channel(5.0), channel(3.0), channel(1.0)};
}

// The i-th of an infinite sequence of well-spread colours; a few repeat.
Color candidate(unsigned i) {
  const double saturation = between(least_saturation, most_saturation, van_der_corput(i, 2));
  const double value = between(least_value, most_value, van_der_corput(i, 3));
  return from_hsv(fraction(first_hue + i / golden_ratio), saturation, value);
}

bool are_colors_of_labels(const std::vector<Color>& colors) {
  std::unordered_set<std::uint32_t> of_labels{packed(null_color)};
  for (const Color& color : label_colors(most_tubes_of_scenes)) of_labels.insert(packed(color));
  return std::ranges::all_of(colors, [&](const Color& color) { return of_labels.contains(packed(color)); });
}

// Beyond the last colour, they begin again with the first tube's.
std::int32_t label_with_the_color_of(std::int32_t label) {
  return label <= most_tubes ? label : 1 + (label - 1) % most_tubes;
}

std::vector<Color> colors_of(const std::vector<std::int32_t>& labels) {
  const auto last = std::ranges::max_element(labels);
  const std::int32_t tubes = last == labels.end() ? 0 : std::clamp(*last, bin_label, most_tubes);
  const std::vector<Color> of_labels = label_colors(tubes);
  std::vector<Color> colors;
  colors.reserve(labels.size());
  for (const std::int32_t label : labels) {
    colors.push_back(label == null_label
                         ? null_color
                         : of_labels[static_cast<std::size_t>(label_with_the_color_of(label))]);
  }
  return colors;
}

}  // namespace

std::vector<Color> label_colors(int tubes) {
  if (tubes < 0 || tubes > most_tubes) {
    throw InputError({"", 0, "tubes"}, std::to_string(tubes), fmt::format("0 to {}", most_tubes));
  }
  const auto size = static_cast<std::size_t>(tubes) + 1;
  std::vector<Color> colors{bin_color};
  colors.reserve(size);
  std::vector<bool> taken(std::size_t{1} << 24);  // one bit per possible colour
  for (unsigned i = 1; colors.size() < size; ++i) {
    const Color color = candidate(i);
    if (taken[packed(color)]) continue;
    taken[packed(color)] = true;
    colors.push_back(color);
  }
  return colors;
}

std::vector<std::int32_t> labels_from_colors(const std::vector<Color>& colors, int tubes,
                                             const std::string& file) {
  std::unordered_map<std::uint32_t, std::int32_t> label_of{{packed(null_color), null_label}};
  std::int32_t next_label = bin_label;
  for (const Color& color : label_colors(tubes)) label_of.emplace(packed(color), next_label++);

  std::vector<std::int32_t> labels;
  labels.reserve(colors.size());
  for (const Color& color : colors) {
    const auto label = label_of.find(packed(color));
    if (label == label_of.end()) {
      throw InputError(
          {file, 0, fmt::format("colour of point {}", labels.size() + 1)},
          fmt::format("({}, {}, {})", color[0], color[1], color[2]),
          fmt::format("black or one of the {} colours of a scene of {} tubes", tubes + 1, tubes));
    }
    labels.push_back(label->second);
  }
  return labels;
}

PointCloud labelled(PointCloud cloud, std::vector<std::int32_t> labels) {
  cloud.labels = std::move(labels);
  if (!are_colors_of_labels(cloud.colors)) return cloud;
  cloud.colors = colors_of(cloud.labels);
  return cloud;
}

}  // namespace tanglebin
