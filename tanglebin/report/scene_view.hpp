#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/geometry/support.hpp"
#include "tanglebin/geometry/tube.hpp"

// Scenes in 3D on an HTML page.
namespace tanglebin {

/// Labels of a scene's points and the tubes behind them: the truth, or what a method found.
struct Labelling {
  std::string name;                  ///< "truth", "axis"
  std::vector<std::int32_t> labels;  ///< of each point of the cloud; empty if only the tubes are known
  std::vector<Tube> tubes;           ///< may be empty
};

/// A scene to look at.
struct ViewedScene {
  std::string name;                ///< "A10/1"
  PointCloud cloud;                ///< m, world frame. Its labels are not shown: those of the labellings are.
  std::optional<Labelling> truth;  ///< with at least one tube among its labels, if it has any
  std::vector<Labelling> found;    ///< of any number of methods
  Support support;
};

/// A scene on a page has at most this many points; of more, a random part is shown, always the same.
inline constexpr std::size_t most_viewed_points = 200'000;

/// The scene as a JSON object for scene_view.js, with at most `most_points` of its points. Found labels are
/// shown as those of the true tubes that they are assigned to (shown_labels()); scores count all points.
/// Throws InputError with the scene's name for labels above 32767, and for a scene without points and tubes.
std::string scene_json(const ViewedScene& scene, std::size_t most_points = most_viewed_points);

/// A <figure> in which a reader turns and chooses among scenes, given as scene_json() has them, at least one.
/// Without WebGL or JavaScript it shows `instead_html`.
std::string scene_figure(const std::vector<std::string>& scenes_json, const std::string& instead_html);

/// The style sheet and the scripts that scene_figure() relies on, once on a page, as HTML.
std::string scene_style();
std::string scene_scripts();

/// A page with one scene. Throws as scene_json() does.
std::string view_page(const ViewedScene& scene);

}  // namespace tanglebin
