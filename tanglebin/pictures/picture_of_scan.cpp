#include "tanglebin/pictures/picture_of_scan.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "tanglebin/base/error.hpp"
#include "tanglebin/pictures/palette.hpp"

namespace tanglebin {
namespace {

constexpr int widest_panel = 480;  // pixels
constexpr Color black{0, 0, 0};

/// Interpolates between two colours; `share` is in [0, 1].
Color blend(const Color& from, const Color& to, double share) {
  Color color{};
  for (std::size_t i = 0; i < color.size(); ++i) {
    color[i] = static_cast<std::uint8_t>(std::lround(from[i] + share * (to[i] - from[i])));
  }
  return color;
}

/// Interpolates along three colours.
Color blend(const Color& first, const Color& middle, const Color& last, double share) {
  const double clamped = std::clamp(share, 0.0, 1.0);
  return clamped < 0.5 ? blend(first, middle, 2 * clamped) : blend(middle, last, 2 * clamped - 1);
}

bool is_there(const Pixel& pixel) {
  return pixel.label != null_label;
}

struct Depths {
  float nearest = std::numeric_limits<float>::infinity();
  float farthest = 0;
};

Depths depths_of(const Scan& scan) {
  Depths depths;
  for (const Pixel& pixel : scan.pixels) {
    if (!is_there(pixel)) continue;
    depths.nearest = std::min(depths.nearest, pixel.depth);
    depths.farthest = std::max(depths.farthest, pixel.depth);
  }
  return depths;
}

Color color_of_depth(const Pixel& pixel, const Depths& depths) {
  constexpr Color near{255, 255, 255};
  constexpr Color far{40, 40, 40};
  const double range = std::max(1e-6F, depths.farthest - depths.nearest);
  return blend(near, far, std::clamp((pixel.depth - depths.nearest) / range, 0.0, 1.0));
}

Color color_of_signal(double share) {
  return blend({20, 20, 90}, {40, 150, 110}, {250, 230, 60}, share);
}

Color color_of_error(double error) {
  return blend({30, 60, 200}, {255, 255, 255}, {200, 30, 30}, 0.5 + error / (2 * largest_error_in_picture));
}

int quotient_rounded_up(int dividend, int divisor) {
  return (dividend + divisor - 1) / divisor;
}

/// Six panels, three in a row.
class Panels {
public:
  explicit Panels(const PixelWindow& window)
      : window_(window),
        step_(quotient_rounded_up(window.width, widest_panel)),
        width_(quotient_rounded_up(window.width, step_)),
        height_(quotient_rounded_up(window.height, step_)),
        picture_{3 * width_, 2 * height_, {}} {
    picture_.pixels.resize(static_cast<std::size_t>(picture_.width) *
                           static_cast<std::size_t>(picture_.height));
  }

  /// Fills a panel with color(u, v) of the image's columns and rows.
  template <typename ColorOf>
  void fill(int column, int row, const ColorOf& color) {
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        const auto i =
            static_cast<std::size_t>(row * height_ + y) * static_cast<std::size_t>(picture_.width) +
            static_cast<std::size_t>(column * width_ + x);
        picture_.pixels[i] = color(window_.left + x * step_, window_.top + y * step_);
      }
    }
  }

  Picture take() { return std::move(picture_); }

private:
  PixelWindow window_;
  int step_;
  int width_;
  int height_;
  Picture picture_;
};

}  // namespace

Picture picture_of_scan(const Scan& ideal, const Scan& measured, const std::string& name) {
  if (std::ranges::none_of(ideal.pixels, is_there)) {
    throw InputError({.file = name, .line = 0, .field = ""}, "a scanner that sees nothing of the scene",
                     "one that looks at the scene");
  }
  const Depths depths = depths_of(ideal);
  const std::vector<Color> colors = palette(std::ranges::max(ideal.pixels, {}, &Pixel::label).label, name);
  const double brightest = measured.snr.empty() ? 1 : std::ranges::max(measured.snr);
  const auto depth_in = [&](const Scan& scan) {
    return [&](int u, int v) {
      const Pixel& pixel = scan.at(u, v);
      return is_there(pixel) ? color_of_depth(pixel, depths) : black;
    };
  };
  const auto label_in = [&](const Scan& scan) {
    return [&](int u, int v) {
      const Pixel& pixel = scan.at(u, v);
      return is_there(pixel) ? colors[static_cast<std::size_t>(pixel.label)] : black;
    };
  };
  const auto signal = [&](int u, int v) {
    if (!is_there(measured.at(u, v))) return black;
    return color_of_signal(measured.snr.empty() ? 1 : measured.snr[measured.index(u, v)] / brightest);
  };
  const auto error = [&](int u, int v) {
    const Pixel& truth = ideal.at(u, v);
    const Pixel& found = measured.at(u, v);
    return is_there(truth) && is_there(found) ? color_of_error(found.range - truth.range) : black;
  };

  Panels panels(ideal.window);
  panels.fill(0, 0, depth_in(ideal));
  panels.fill(1, 0, label_in(ideal));
  panels.fill(2, 0, signal);
  panels.fill(0, 1, depth_in(measured));
  panels.fill(1, 1, label_in(measured));
  panels.fill(2, 1, error);
  return panels.take();
}

}  // namespace tanglebin
