#include "tanglebin/scan/occlusion.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "tanglebin/geometry/support.hpp"
#include "tanglebin/scan/scan.hpp"
#include "tanglebin/scan/scanner.hpp"

namespace tanglebin {
namespace {

std::uint32_t number_of(const Camera& camera, int u, int v) {
  return static_cast<std::uint32_t>(v) * static_cast<std::uint32_t>(camera.width) +
         static_cast<std::uint32_t>(u);
}

WholeView view_of(const Scan& scan, int id) {
  WholeView view{id, {}, {}};
  const PixelWindow& window = scan.window;
  for (int v = window.top; v < window.top + window.height; ++v) {
    for (int u = window.left; u < window.left + window.width; ++u) {
      const Pixel& pixel = scan.at(u, v);
      if (pixel.label == null_label) continue;
      view.pixels.push_back(number_of(scan.camera, u, v));
      view.ranges.push_back(pixel.range);
    }
  }
  return view;
}

/// Part of what two views share.
struct Region {
  std::vector<std::uint32_t> pixels;  ///< ascending
  std::vector<float> ranges;          ///< m, of the nearer view
};

/// Where the first of two views is nearer, and where the second is.
struct SharedPixels {
  Region first_over;
  Region second_over;
};

SharedPixels shared_pixels(const WholeView& first, const WholeView& second) {
  SharedPixels shared;
  const auto add = [](Region& region, std::uint32_t pixel, float range) {
    region.pixels.push_back(pixel);
    region.ranges.push_back(range);
  };
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < first.pixels.size() && j < second.pixels.size()) {
    if (first.pixels[i] < second.pixels[j]) {
      ++i;
    } else if (second.pixels[j] < first.pixels[i]) {
      ++j;
    } else {
      const bool is_first = first.ranges[i] <= second.ranges[j];
      add(is_first ? shared.first_over : shared.second_over, first.pixels[i],
          std::min(first.ranges[i], second.ranges[j]));
      ++i;
      ++j;
    }
  }
  return shared;
}

/// Finds the connected parts of a region.
class ConnectedParts {
public:
  ConnectedParts(const Region& region, const Camera& camera)
      : region_(region), camera_(camera), is_taken_(region.pixels.size()) {}

  /// In order of their first pixels.
  std::vector<Region> find() {
    std::vector<Region> parts;
    for (std::size_t i = 0; i < region_.pixels.size(); ++i) {
      if (!is_taken_[i]) parts.push_back(part_around(i));
    }
    return parts;
  }

private:
  Region part_around(std::size_t first) {
    std::vector<std::size_t> part;
    take(first, part);
    for (std::size_t next = 0; next < part.size(); ++next) {
      const auto width = static_cast<std::uint32_t>(camera_.width);
      const int u = static_cast<int>(region_.pixels[part[next]] % width);
      const int v = static_cast<int>(region_.pixels[part[next]] / width);
      for (int row = v - 1; row <= v + 1; ++row) {
        for (int column = u - 1; column <= u + 1; ++column) take_if_there(column, row, part);
      }
    }
    std::ranges::sort(part);
    Region result;
    for (const std::size_t i : part) {
      result.pixels.push_back(region_.pixels[i]);
      result.ranges.push_back(region_.ranges[i]);
    }
    return result;
  }

  void take_if_there(int u, int v, std::vector<std::size_t>& part) {
    if (u < 0 || v < 0 || u >= camera_.width || v >= camera_.height) return;
    const std::uint32_t pixel = number_of(camera_, u, v);
    const auto found = std::ranges::lower_bound(region_.pixels, pixel);
    if (found == region_.pixels.end() || *found != pixel) return;
    const auto i = static_cast<std::size_t>(found - region_.pixels.begin());
    if (!is_taken_[i]) take(i, part);
  }

  void take(std::size_t i, std::vector<std::size_t>& part) {
    is_taken_[i] = true;
    part.push_back(i);
  }

  const Region& region_;
  const Camera& camera_;
  std::vector<bool> is_taken_;
};

/// The labels of an ideal scan, by pixel.
class SeenLabels {
public:
  explicit SeenLabels(const Scan& scan) : scan_(scan) {}

  std::int32_t at(std::uint32_t pixel) const {
    const auto width = static_cast<std::uint32_t>(scan_.camera.width);
    return scan_.at(static_cast<int>(pixel % width), static_cast<int>(pixel / width)).label;
  }

  std::size_t count(const std::vector<std::uint32_t>& pixels, std::int32_t label) const {
    return static_cast<std::size_t>(
        std::ranges::count_if(pixels, [&](std::uint32_t pixel) { return at(pixel) == label; }));
  }

private:
  const Scan& scan_;
};

Crossing crossing(const Region& region, int over, int under, const SeenLabels& seen, const Camera& camera) {
  const auto width = static_cast<std::uint32_t>(camera.width);
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < region.pixels.size(); ++i) {
    const Eigen::Vector2d at(region.pixels[i] % width, region.pixels[i] / width);
    const Ray ray = ray_through(camera, at.x(), at.y());
    pixel += at;
    point += ray.origin + static_cast<double>(region.ranges[i]) * ray.direction;
  }
  const auto pixels = static_cast<double>(region.pixels.size());
  return {over, under, region.pixels.size(), seen.count(region.pixels, over), pixel / pixels, point / pixels};
}

}  // namespace

std::vector<WholeView> whole_views(const std::vector<Tube>& tubes, const Camera& camera) {
  Support nothing;
  nothing.shape = Support::Shape::nothing;
  std::vector<WholeView> views;
  views.reserve(tubes.size());
  for (const Tube& tube : tubes) views.push_back(view_of(scan({tube}, nothing, camera), tube.id));
  return views;
}

Occlusions occlusions(const std::vector<Tube>& tubes, const std::vector<WholeView>& views, const Bin& bin,
                      const Camera& camera) {
  const Scan scene = scan(tubes, bin, camera);
  const SeenLabels seen(scene);
  Occlusions result;
  for (const WholeView& view : views)
    result.tubes.push_back({view.tube, view.pixels.size(), seen.count(view.pixels, view.tube)});

  const auto add = [&](const Region& region, int over, int under) {
    for (const Region& part : ConnectedParts(region, camera).find())
      result.crossings.push_back(crossing(part, over, under, seen, camera));
  };
  const WholeView bin_view = view_of(scan({}, bin, camera), bin_label);
  for (const WholeView& view : views) add(shared_pixels(bin_view, view).first_over, bin_label, view.tube);
  for (std::size_t i = 0; i < views.size(); ++i) {
    for (std::size_t j = i + 1; j < views.size(); ++j) {
      const SharedPixels shared = shared_pixels(views[i], views[j]);
      add(shared.first_over, views[i].tube, views[j].tube);
      add(shared.second_over, views[j].tube, views[i].tube);
    }
  }
  return result;
}

}  // namespace tanglebin
