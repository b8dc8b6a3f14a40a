#include "tanglebin/scene/camera_info.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <utility>
#include <vector>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/text.hpp"

namespace tanglebin {
namespace {

/// A mapping of a YAML file, whose values have one of several names: those of a file, of ROS 2 and of ROS 1.
class YamlMap {
public:
  using Names = std::initializer_list<const char*>;

  YamlMap(std::string file, const YAML::Node& node) : file_(std::move(file)), node_(node) {
    if (!node_.IsMap())
      throw InputError({file_, line_of(node_), ""}, node_.IsSequence() ? "a list" : "a single value",
                       "an object: names with values");
  }

  bool has(Names names) const { return find(names).has_value(); }

  int pixels(Names names) const {
    const Found found = get(names);
    constexpr int most = 1 << 26;
    const auto value = found.node.IsScalar() ? to_number<int>(found.node.Scalar()) : std::nullopt;
    if (!value || *value < 0 || *value > most) fail(found, "a number of pixels");
    return *value;
  }

  /// The numbers of a list, or of the list `data` of a matrix. Empty if there is none.
  std::vector<double> numbers(Names names) const {
    const std::optional<Found> found = find(names);
    std::vector<double> result;
    if (!found) return result;
    const YAML::Node list = found->node.IsMap() ? found->node["data"] : found->node;
    if (!list.IsDefined() || !list.IsSequence()) fail(*found, "a list of numbers");
    for (const YAML::Node& element : list) {
      const auto value = element.IsScalar() ? to_number<double>(element.Scalar()) : std::nullopt;
      if (!value || !std::isfinite(*value)) fail({found->name, element}, "a finite number");
      result.push_back(*value);
    }
    return result;
  }

  std::optional<YamlMap> map(Names names) const {
    const std::optional<Found> found = find(names);
    if (!found || found->node.IsNull()) return std::nullopt;
    if (!found->node.IsMap()) fail(*found, "a mapping");
    return YamlMap(file_, found->node);
  }

  [[noreturn]] void fail(Names names, const std::string& found, const std::string& expected) const {
    const std::optional<Found> there = find(names);
    throw InputError({file_, there ? line_of(there->node) : 0, there ? there->name : *names.begin()}, found,
                     expected);
  }

private:
  struct Found {
    std::string name;
    const YAML::Node node;  // asked for what is not there, one that is not constant adds it
  };

  static std::size_t line_of(const YAML::Node& node) {
    return static_cast<std::size_t>(node.Mark().line + 1);
  }

  std::optional<Found> find(Names names) const {
    for (const char* name : names) {
      if (const YAML::Node value = node_[name]; value.IsDefined()) return Found{name, value};
    }
    return std::nullopt;
  }

  Found get(Names names) const {
    std::optional<Found> found = find(names);
    if (!found) throw InputError({file_, 0, *names.begin()}, "is missing");
    return *found;
  }

  [[noreturn]] void fail(const Found& found, const std::string& expected) const {
    const std::string text =
        found.node.IsDefined() && found.node.IsScalar() ? excerpt(found.node.Scalar()) : "no single value";
    throw InputError({file_, line_of(found.node), found.name}, text, expected);
  }

  std::string file_;
  const YAML::Node node_;
};

void expect_undistorted(const YamlMap& info) {
  const auto names = {"distortion_coefficients", "d", "D"};
  const std::vector<double> distortion = info.numbers(names);
  if (std::ranges::all_of(distortion, [](double value) { return value == 0; })) return;
  info.fail(names, fmt::format("[{:.6g}]", fmt::join(distortion, ", ")),
            "zeros, or a projection matrix, which is the rectified image's (in ROS, image_rect)");
}

void expect_whole_image(const YamlMap& info, const Intrinsics& intrinsics) {
  for (const char* name : {"binning_x", "binning_y"}) {
    if (info.has({name}) && info.pixels({name}) > 1)
      info.fail({name}, "a binned image", "0 or 1: the camera_info of the image itself");
  }
  const std::optional<YamlMap> region = info.map({"roi"});
  if (!region || region->pixels({"width"}) == 0) return;
  if (region->pixels({"width"}) != intrinsics.width || region->pixels({"height"}) != intrinsics.height)
    region->fail({"width"}, "a region of the image", "0: the camera_info of the image itself");
}

// The projection matrix is the rectified image's; the camera matrix and the distortion are those of the image
// before. ROS has one camera_info for both.
Intrinsics read_info(const YamlMap& info) {
  std::vector<double> projection = info.numbers({"projection_matrix", "p", "P"});
  const bool has_projection = !projection.empty() && projection[0] != 0;
  const auto names = {"camera_matrix", "k", "K"};
  if (!has_projection) {
    expect_undistorted(info);
    projection = info.numbers(names);
  }
  const std::size_t columns = has_projection ? 4 : 3;
  if (projection.size() != 3 * columns)
    info.fail(names, fmt::format("{} numbers", projection.size()),
              "9 numbers, or a projection matrix of 12: a camera_info of ROS");
  const Intrinsics intrinsics{.width = info.pixels({"image_width", "width"}),
                              .height = info.pixels({"image_height", "height"}),
                              .fx = projection[0],
                              .fy = projection[columns + 1],
                              .cx = projection[2],
                              .cy = projection[columns + 2]};
  expect_whole_image(info, intrinsics);
  return intrinsics;
}

}  // namespace

Intrinsics read_camera_info(const std::string& text, const std::string& name) {
  // Reading takes a while for each byte. A camera_info has less than 4 kB.
  constexpr std::size_t longest = std::size_t{1} << 16U;
  if (text.size() > longest)
    throw InputError(
        {name, 0, ""}, fmt::format("{} bytes", text.size()),
        fmt::format("a camera file: JSON, or a camera_info of ROS of at most {} bytes", longest));
  try {
    return read_info({name, YAML::Load(text)});
  } catch (const YAML::Exception& error) {
    const std::size_t line = error.mark.is_null() ? 0 : static_cast<std::size_t>(error.mark.line + 1);
    throw InputError({name, line, ""}, "neither JSON nor YAML: " + error.msg);
  }
}

}  // namespace tanglebin
