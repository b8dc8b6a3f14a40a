#include "tanglebin/model/view_check.hpp"

#include <fmt/core.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "tanglebin/base/median.hpp"
#include "tanglebin/base/stride.hpp"
#include "tanglebin/model/floor_check.hpp"
#include "tanglebin/model/rim_check.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

Finding warning(const char* code, std::string message) {
  return {Finding::Severity::warning, code, std::move(message)};
}

// The median distance, in pixels, of an organized cloud's points from the pixels that they are stored at.
std::optional<double> distance_from_pixels(const PointCloud& cloud, const Camera& camera) {
  std::vector<double> distances;
  constexpr std::size_t wanted = 2000;
  const std::size_t stride = sampling_stride(cloud.points.size(), wanted);
  for (std::size_t i = 0; i < cloud.points.size(); i += stride) {
    if (!cloud.points[i].allFinite()) continue;
    const std::optional<Eigen::Vector2d> image = project(camera, cloud.points[i].cast<double>());
    const std::size_t row = i / cloud.width;
    const Eigen::Vector2d pixel(static_cast<double>(i % cloud.width), static_cast<double>(row));
    if (image) distances.push_back((*image - pixel).norm());
  }
  if (distances.empty()) return std::nullopt;
  return median(std::move(distances));
}

std::optional<Finding> doubt_of_order(const PointCloud& cloud, const Camera& camera) {
  const auto width = static_cast<std::size_t>(camera.width);
  const auto height = static_cast<std::size_t>(camera.height);
  if (cloud.width != width || cloud.height != height) {
    return warning(
        "camera",
        fmt::format("the cloud is organized in {} x {} pixels, but the camera's image has {} x {}: the "
                    "camera's intrinsics must be those of the cloud's image",
                    cloud.width, cloud.height, width, height));
  }
  constexpr double tolerance = 3;
  const std::optional<double> distance = distance_from_pixels(cloud, camera);
  if (!distance || *distance <= tolerance) return std::nullopt;
  return warning("camera",
                 fmt::format("the points are projected {:.0f} pixels beside those that they are stored "
                             "at: the camera's intrinsics or its pose are not the cloud's",
                             *distance));
}

/// What the pixels in a part of the image have.
struct PixelUse {
  std::size_t pixels = 0;  ///< with points
  std::size_t points = 0;  ///< in them
  std::size_t lonely = 0;  ///< none of the eight pixels around has a point
  std::size_t deep = 0;    ///< with points at several depths

  double share(std::size_t part) const { return static_cast<double>(part) / static_cast<double>(pixels); }
};

/// The points in each pixel of a square part of the image.
class PixelDepths {
public:
  PixelDepths(const PixelPosition& middle, int reach)
      : left_(middle.column - reach), top_(middle.row - reach), size_(2 * reach + 1), pixels_(area()) {}

  void add(const PixelPosition& pixel, double depth) {
    const int u = pixel.column - left_;
    const int v = pixel.row - top_;
    if (u < 0 || v < 0 || u >= size_ || v >= size_) return;
    Depths& depths = at(u, v);
    ++depths.points;
    depths.nearest = std::min(depths.nearest, depth);
    depths.farthest = std::max(depths.farthest, depth);
  }

  // Depths that differ by more than this (m) are several.
  PixelUse use(double tolerance) {
    PixelUse use;
    for (int v = 1; v + 1 < size_; ++v) {
      for (int u = 1; u + 1 < size_; ++u) {
        const Depths& depths = at(u, v);
        if (depths.points == 0) continue;
        ++use.pixels;
        use.points += depths.points;
        if (!has_neighbour(u, v)) ++use.lonely;
        if (depths.farthest - depths.nearest > tolerance) ++use.deep;
      }
    }
    return use;
  }

private:
  struct Depths {
    std::size_t points = 0;
    double nearest = std::numeric_limits<double>::infinity();
    double farthest = 0;
  };

  std::size_t area() const { return static_cast<std::size_t>(size_) * static_cast<std::size_t>(size_); }
  Depths& at(int u, int v) {
    return pixels_[static_cast<std::size_t>(v) * static_cast<std::size_t>(size_) +
                   static_cast<std::size_t>(u)];
  }

  bool has_neighbour(int u, int v) {
    for (int i = -1; i <= 1; ++i) {
      for (int j = -1; j <= 1; ++j) {
        if ((i != 0 || j != 0) && at(u + i, v + j).points > 0) return true;
      }
    }
    return false;
  }

  int left_;
  int top_;
  int size_;
  std::vector<Depths> pixels_;
};

// Around one of the points that were kept. Looks at all points near it.
PixelUse pixel_use(const PointCloud& cloud, const Vector3f& middle, const KnownScene& known) {
  const Camera& camera = known.camera;
  const std::optional<SeenPixel> at_middle = seen_pixel(camera, middle.cast<double>());
  if (!at_middle) return {};
  constexpr int reach = 50;  // pixels
  PixelDepths depths(at_middle->pixel, reach);
  const double ball = reach * at_middle->depth / std::max(camera.fx, camera.fy);
  const auto square = static_cast<float>(ball * ball);
  for (const Vector3f& point : cloud.points) {
    if (!((point - middle).squaredNorm() < square)) continue;
    if (const auto seen = seen_pixel(camera, point.cast<double>())) depths.add(seen->pixel, seen->depth);
  }
  return depths.use(std::ranges::min(known.kinds, {}, &TubeKind::radius).radius);
}

std::optional<Finding> doubt_of_resolution(const PointCloud& cloud, const std::vector<std::size_t>& kept,
                                           const KnownScene& known) {
  if (kept.empty()) return std::nullopt;
  const PixelUse use = pixel_use(cloud, cloud.points[kept[kept.size() / 2]], known);
  constexpr std::size_t points_min = 100;
  if (use.points < points_min) return std::nullopt;
  constexpr double points_max = 1.5;
  if (use.share(use.points) > points_max) {
    return warning(
        "camera",
        fmt::format(
            "{:.1f} points lie in each pixel of the camera's image, where one camera sees one: if one "
            "camera took the cloud, the image may be of a higher resolution, or the camera's pose in "
            "another unit; if it is of several views, or the camera is made up, tubes are found all "
            "the same, but points behind others may be null (docs/real-scans.md)",
            use.share(use.points)));
  }
  constexpr double deep_max = 0.02;
  if (use.share(use.deep) > deep_max) {
    return warning(
        "camera",
        fmt::format("in {:.0f} % of the camera's pixels there are points at several depths, of which it "
                    "cannot have seen all: is its pose right? is the cloud mirrored?",
                    100 * use.share(use.deep)));
  }
  constexpr double lonely_max = 0.5;
  if (use.share(use.lonely) > lonely_max) {
    return warning(
        "camera",
        fmt::format("{:.0f} % of the points have no neighbour in the next pixels of the camera's image: "
                    "the image may be of a lower resolution, or the cloud was thinned out",
                    100 * use.share(use.lonely)));
  }
  return std::nullopt;
}

/// The cells of an image in which a bin's rim should be seen: a hundred across it.
class RimCells {
public:
  RimCells(const Support& support, const Camera& camera)
      : camera_(camera),
        size_(std::max(1, camera.width / 100)),
        columns_(camera.width / size_ + 1),
        cells_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(camera.height / size_ + 1)) {
    const Bin& bin = support.bin;
    const double x = (bin.length + bin.wall) / 2;
    const double y = (bin.width + bin.wall) / 2;
    const auto add = [&](double at_x, double at_y) {
      const Vector3d point = support.pose * Vector3d(at_x, at_y, bin.height);
      if (const auto seen = seen_pixel(camera, point)) at(seen->pixel).depth = seen->depth;
    };
    constexpr int steps = 100;
    for (int i = 0; i <= steps; ++i) {
      const double share = 2.0 * i / steps - 1;
      for (const double side : {-1.0, 1.0}) {
        add(share * x, side * y);
        add(side * x, share * y);
      }
    }
  }

  void see(const Vector3d& point, double tolerance) {
    const auto seen = seen_pixel(camera_, point);
    if (!seen) return;
    Cell& cell = at(seen->pixel);
    if (cell.depth == 0) return;
    const double beyond = seen->depth - cell.depth;
    (beyond > tolerance ? cell.is_seen_past : beyond < -tolerance ? cell.is_hidden : cell.is_found) = true;
  }

  /// How many cells of the rim show what. Those where only something in front is seen are in none.
  struct Counts {
    std::size_t found = 0;
    std::size_t seen_past = 0;
    std::size_t empty = 0;  ///< without points

    std::size_t all() const { return found + seen_past + empty; }
  };
  Counts counts() const {
    Counts counts;
    for (const Cell& cell : cells_) {
      if (cell.depth == 0) continue;
      if (cell.is_found) {
        ++counts.found;
      } else if (!cell.is_hidden) {
        ++(cell.is_seen_past ? counts.seen_past : counts.empty);
      }
    }
    return counts;
  }

private:
  struct Cell {
    double depth = 0;  ///< m, of the rim; 0 where there is none
    bool is_found = false;
    bool is_seen_past = false;
    bool is_hidden = false;
  };

  Cell& at(const PixelPosition& pixel) {
    const auto row = static_cast<std::size_t>(pixel.row / size_);
    const auto column = static_cast<std::size_t>(pixel.column / size_);
    return cells_[row * static_cast<std::size_t>(columns_) + column];
  }

  const Camera& camera_;
  int size_;  // of a cell, pixels
  int columns_;
  std::vector<Cell> cells_;
};

// What a scanner did not measure does not speak against the bin if enough of the rim was found.
bool is_there(const RimCells::Counts& cells, std::size_t enough) {
  constexpr double least = 0.4;
  const auto are_found_of = [&](std::size_t part) {
    return static_cast<double>(cells.found) >= least * static_cast<double>(part);
  };
  return are_found_of(cells.all()) || (cells.found >= enough && are_found_of(cells.found + cells.seen_past));
}

std::optional<Finding> doubt_of_rim(const PointCloud& cloud, const KnownScene& known) {
  RimCells rim(known.support, known.camera);
  constexpr double tolerance = 0.015;
  constexpr std::size_t wanted = 50'000;
  const std::size_t stride = sampling_stride(cloud.points.size(), wanted);
  for (std::size_t i = 0; i < cloud.points.size(); i += stride) {
    if (cloud.points[i].allFinite())
      rim.see(cloud.points[i].cast<double>(), tolerance + known.support.margin);
  }
  const RimCells::Counts cells = rim.counts();
  constexpr std::size_t cells_min = 20;
  if (cells.all() < cells_min || is_there(cells, cells_min)) return std::nullopt;
  const auto percent = [&](std::size_t part) {
    return 100 * static_cast<double>(part) / static_cast<double>(cells.all());
  };
  return warning("bin",
                 fmt::format("of the bin's rim, {:.0f} % is where the scene has it, {:.0f} % is seen past "
                             "and {:.0f} % has no points: the bin may have another size or pose",
                             percent(cells.found), percent(cells.seen_past), percent(cells.empty)));
}

/// The points in the solid and under a bin, m, in the support's frame.
struct SupportContact {
  std::size_t looked_at = 0;
  std::vector<double> inside;  ///< how deep in floor or walls
  std::vector<double> under;   ///< how deep below the inside of a bin, and not in its floor

  double share_of(const std::vector<double>& points) const {
    return static_cast<double>(points.size()) / static_cast<double>(std::max<std::size_t>(1, looked_at));
  }
};

SupportContact contact_of(const PointCloud& cloud, const KnownScene& known) {
  const Support& support = known.support;
  const Eigen::Isometry3d to_support = support.pose.inverse(Eigen::Isometry);
  const std::vector<Eigen::AlignedBox3d> parts = solid_parts(support);
  const double reach = std::max(0.02, known.kinds.front().radius);
  SupportContact contact;
  constexpr std::size_t wanted = 5'000;
  const std::size_t stride = sampling_stride(cloud.points.size(), wanted);
  for (std::size_t i = 0; i < cloud.points.size(); i += stride) {
    if (!cloud.points[i].allFinite()) continue;
    const Vector3d point = to_support * cloud.points[i].cast<double>();
    const bool is_above_it =
        support.shape == Support::Shape::plane || is_over_floor(support.bin, point, reach);
    ++contact.looked_at;
    for (const Eigen::AlignedBox3d& part : parts) {
      const double depth = std::min((point - part.min()).minCoeff(), (part.max() - point).minCoeff());
      if (depth > 0) contact.inside.push_back(depth);
    }
    if (is_above_it && support.shape == Support::Shape::bin && point.z() < parts.front().min().z() - reach)
      contact.under.push_back(-point.z());
  }
  return contact;
}

constexpr double out_of_place_max = 0.02;  // share of the points

std::optional<Finding> doubt_of_solid(const SupportContact& contact, const Support& support) {
  constexpr double tolerance = 0.005;
  std::vector<double> deep;
  std::ranges::copy_if(contact.inside, std::back_inserter(deep),
                       [&](double depth) { return depth > tolerance + support.margin; });
  const double share = contact.share_of(deep);
  if (share <= out_of_place_max) return std::nullopt;
  return warning(
      name_of(support.shape).c_str(),
      fmt::format("{:.0f} % of the points are inside the {}, {:.0f} mm deep in the median: the support may "
                  "have another size or pose",
                  100 * share,
                  support.shape == Support::Shape::bin ? "bin's floor and walls" : "plane's solid side",
                  1000 * median(std::move(deep))));
}

// The floor hides what is under it.
std::optional<Finding> doubt_of_depth(const SupportContact& contact) {
  const double share = contact.share_of(contact.under);
  if (share <= out_of_place_max) return std::nullopt;
  return warning("bin",
                 fmt::format("{:.0f} % of the points are under the bin's floor, {:.3g} m deep in the median, "
                             "where the camera cannot have seen them: do they stand for nothing measured? "
                             "They are null",
                             100 * share, median(contact.under)));
}

}  // namespace

std::vector<Finding> doubts_of_camera(const PointCloud& cloud, const KnownScene& known, const Model& model) {
  const std::optional<Finding> doubt = cloud.height > 1 ? doubt_of_order(cloud, known.camera)
                                                        : doubt_of_resolution(cloud, model.filtered, known);
  return doubt ? std::vector{*doubt} : std::vector<Finding>{};
}

std::vector<Finding> doubts_of_support(const PointCloud& cloud, const KnownScene& known, const Model& model) {
  std::vector<Finding> doubts;
  const Support& support = known.support;
  if (support.shape == Support::Shape::nothing) return doubts;
  const auto add = [&](const std::optional<Finding>& doubt) {
    if (doubt) doubts.push_back(*doubt);
  };
  const SupportContact contact = contact_of(cloud, known);
  add(doubt_of_floor_height(cloud, known, model));
  add(doubt_of_solid(contact, support));
  add(doubt_of_depth(contact));
  // A cloud of the tubes alone has no rim.
  constexpr std::size_t share = 50;
  const bool shows_support = share * model.counts.on_support > model.counts.all - model.counts.invalid;
  if (support.shape == Support::Shape::bin && shows_support) {
    const std::optional<Finding> doubt = doubt_of_rim_place(cloud, support);
    add(doubt ? doubt : doubt_of_rim(cloud, known));
  }
  return doubts;
}

}  // namespace tanglebin
