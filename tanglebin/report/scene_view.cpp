#include "tanglebin/report/scene_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <span>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/picked.hpp"
#include "tanglebin/files/json_record.hpp"
#include "tanglebin/geometry/labels.hpp"
#include "tanglebin/io/images.hpp"
#include "tanglebin/model/scene/filter.hpp"
#include "tanglebin/pictures/palette.hpp"
#include "tanglebin/pictures/picture.hpp"
#include "tanglebin/report/document.hpp"
#include "tanglebin/report/embedded.hpp"
#include "tanglebin/report/html.hpp"
#include "tanglebin/report/script.hpp"
#include "tanglebin/score/shown_labels.hpp"

namespace tanglebin {
namespace {

using Eigen::AlignedBox3f;
using Eigen::Vector3d;
using Eigen::Vector3f;
using Labels = std::vector<std::int32_t>;

static_assert(std::endian::native == std::endian::little, "browsers read typed arrays in their own order");

// ---- Points
// -------------------------------------------------------------------------------------------------

std::vector<std::size_t> finite_points(const PointCloud& cloud) {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (cloud.points[i].allFinite()) indices.push_back(i);
  }
  return indices;
}

std::vector<std::size_t> at_most(const std::vector<std::size_t>& indices, std::size_t most) {
  constexpr std::uint64_t seed = 1;
  if (indices.size() <= most) return indices;
  return downsample(indices, static_cast<double>(most) / static_cast<double>(indices.size()), seed);
}

template <typename Value>
std::string base64_of(const std::vector<Value>& values) {
  const auto bytes = std::as_bytes(std::span(values));
  return base64({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

/// Positions in steps from the lowest corner: 16 bits for each coordinate.
Json positions_json(const std::vector<Vector3f>& points) {
  constexpr auto largest = static_cast<float>(std::numeric_limits<std::uint16_t>::max());
  AlignedBox3f box;
  for (const Vector3f& point : points) box.extend(point);
  if (box.isEmpty()) box.extend(Vector3f::Zero());
  const float step = std::max(box.sizes().maxCoeff() / largest, std::numeric_limits<float>::min());
  std::vector<std::uint16_t> coordinates;
  coordinates.reserve(3 * points.size());
  for (const Vector3f& point : points) {
    for (const float steps : Vector3f((point - box.min()) / step)) {
      coordinates.push_back(static_cast<std::uint16_t>(std::lround(std::min(steps, largest))));
    }
  }
  return {{"origin", {box.min().x(), box.min().y(), box.min().z()}},
          {"step", step},
          {"coordinates", base64_of(coordinates)}};
}

// ---- Labels and tubes
// ---------------------------------------------------------------------------------------

std::string labels_base64(const Labels& labels) {
  std::vector<std::int16_t> numbers;
  numbers.reserve(labels.size());
  for (const std::int32_t label : labels) numbers.push_back(static_cast<std::int16_t>(label));
  return base64_of(numbers);
}

Json vector_json(const Vector3d& vector) {
  return {to_billionth(vector.x()), to_billionth(vector.y()), to_billionth(vector.z())};
}

Json tube_json(const Tube& tube) {
  Json json{{"label", tube.id}, {"radius", tube.radius}};
  json["nodes"] = Json::array();
  for (const Node& node : tube.nodes) json["nodes"].push_back(vector_json(node.position));
  json["edges"] = Json::array();
  for (const Edge& edge : tube.edges) json["edges"].push_back({edge.from, edge.to});
  return json;
}

Json labelling_json(const Labelling& labelling, const std::vector<std::size_t>& shown) {
  Json json{{"name", labelling.name}};
  if (!labelling.labels.empty()) json["labels"] = labels_base64(picked(labelling.labels, shown));
  json["tubes"] = Json::array();
  for (const Tube& tube : labelling.tubes) json["tubes"].push_back(tube_json(tube));
  return json;
}

Json score_json(const Score& score) {
  Json json{{"micro_recall", score.micro_recall}, {"tubes", Json::array()}};
  for (const TubeScore& tube : score.tubes) {
    json["tubes"].push_back({{"label", tube.label},
                             {"points", tube.points},
                             {"correct", tube.correct_points},
                             {"unlabelled", tube.null_points},
                             {"iou", tube.iou}});
  }
  return json;
}

/// The labels of a labelling, those of its tubes included, ascending, each once.
Labels all_labels(const Labelling& labelling) {
  Labels labels = labelling.labels;
  for (const Tube& tube : labelling.tubes) labels.push_back(tube.id);
  std::ranges::sort(labels);
  labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
  return labels;
}

/// With the labels of the true tubes that its own are assigned to.
Labelling shown_beside(const Labelling& truth, Labelling found, const Score& score) {
  const std::map<std::int32_t, std::int32_t> shown_as =
      shown_labels(score, all_labels(truth), all_labels(found));
  for (std::int32_t& label : found.labels) label = shown_as.at(label);
  for (Tube& tube : found.tubes) tube.id = shown_as.at(tube.id);
  return found;
}

/// The labellings as the page shows them, and their scores.
struct Shown {
  std::vector<Labelling> labellings;  ///< the truth first, where it is known
  std::vector<Json> scores;           ///< of each; null where there is none
};

Shown shown(const ViewedScene& scene) {
  Shown result;
  if (scene.truth) {
    result.labellings.push_back(*scene.truth);
    result.scores.emplace_back();
  }
  for (const Labelling& found : scene.found) {
    if (!scene.truth || scene.truth->labels.empty() || found.labels.empty()) {
      result.labellings.push_back(found);
      result.scores.emplace_back();
      continue;
    }
    const Score counts = score(scene.truth->labels, found.labels);
    result.labellings.push_back(shown_beside(*scene.truth, found, counts));
    result.scores.push_back(score_json(counts));
  }
  return result;
}

// ---- Colours
// ------------------------------------------------------------------------------------------------

std::int32_t largest_label(const std::vector<Labelling>& labellings, const std::string& name) {
  std::int32_t largest = bin_label;
  for (const Labelling& labelling : labellings) {
    for (const std::int32_t label : all_labels(labelling)) largest = std::max(largest, label);
  }
  constexpr std::int32_t most = std::numeric_limits<std::int16_t>::max();
  if (largest > most) {
    throw InputError({name, 0, "label"}, std::to_string(largest), fmt::format("labels up to {}", most));
  }
  return largest;
}

Json palette_json(std::int32_t largest, const std::string& name) {
  Json json = Json::array();
  for (const auto& [red, green, blue] : palette(largest, name)) {
    json.push_back(fmt::format("#{:02x}{:02x}{:02x}", red, green, blue));
  }
  return json;
}

// ---- Support
// ------------------------------------------------------------------------------------------------

/// The edges of a bin's inside; a plane has none.
Json support_json(const Support& support) {
  if (support.shape != Support::Shape::bin) return Json::array();
  const Vector3d half(support.bin.length / 2, support.bin.width / 2, 0);
  Json corners = Json::array();
  for (const double z : {0.0, support.bin.height}) {
    for (const auto& [x, y] : {std::pair(-1, -1), std::pair(1, -1), std::pair(1, 1), std::pair(-1, 1)}) {
      corners.push_back(vector_json(support.pose * Vector3d(x * half.x(), y * half.y(), z)));
    }
  }
  return corners;
}

/// What the points are coloured by: the truth, or else what was found first. None without labels.
Labels first_labels(const ViewedScene& scene) {
  if (scene.truth && !scene.truth->labels.empty()) return scene.truth->labels;
  return scene.found.empty() ? Labels() : scene.found.front().labels;
}

std::vector<Tube> first_tubes(const ViewedScene& scene) {
  return scene.truth ? scene.truth->tubes : scene.found.front().tubes;
}

/// A picture of the scene, for readers who cannot turn it. It has points or tubes.
Picture still_picture(const ViewedScene& scene) {
  constexpr View view{.width = 900, .height = 640};
  if (scene.cloud.points.empty()) {
    return picture_of_tubes(first_tubes(scene), scene.support, view, scene.name);
  }
  PointCloud cloud = scene.cloud;
  cloud.labels = first_labels(scene);
  return picture_of_cloud(cloud, view, scene.name);
}

std::string still_picture_html(const ViewedScene& scene) {
  const Picture picture = still_picture(scene);
  return fmt::format(
      "<img src=\"data:image/png;base64,{}\" width=\"{}\" height=\"{}\" alt=\"A picture of {}.\">\n"
      "<p class=\"note\">To turn it, a browser needs JavaScript and WebGL.</p>\n",
      base64(color_png(picture.width, picture.height, picture.pixels)), picture.width, picture.height,
      escaped(scene.name));
}

bool has_tubes(const Shown& shown) {
  return std::ranges::any_of(shown.labellings,
                             [](const Labelling& labelling) { return !labelling.tubes.empty(); });
}

}  // namespace

std::string scene_json(const ViewedScene& scene, std::size_t most_points) {
  const Shown beside = shown(scene);
  const std::vector<std::size_t> all = finite_points(scene.cloud);
  if (all.empty() && !has_tubes(beside)) {
    throw InputError({scene.name, 0, ""}, "a scene without points and tubes", "at least one");
  }
  const std::vector<std::size_t> drawn = at_most(all, most_points);
  Json points = positions_json(picked(scene.cloud.points, drawn));
  points["count"] = drawn.size();
  points["of"] = all.size();
  if (!scene.cloud.colors.empty()) points["colors"] = base64_of(picked(scene.cloud.colors, drawn));

  Json json{{"name", scene.name}, {"has_truth", scene.truth.has_value()}, {"points", points}};
  json["palette"] = palette_json(largest_label(beside.labellings, scene.name), scene.name);
  json["labellings"] = Json::array();
  for (std::size_t i = 0; i < beside.labellings.size(); ++i) {
    json["labellings"].push_back(labelling_json(beside.labellings[i], drawn));
    json["labellings"].back()["score"] = beside.scores[i];
  }
  json["bin"] = support_json(scene.support);
  return json_text(json);
}

std::string scene_figure(const std::vector<std::string>& scenes_json, const std::string& instead_html) {
  std::string html = "<figure class=\"scene-view\">\n";
  for (const std::string& scene : scenes_json) html += json_script(scene);
  return html + fmt::format("<div class=\"instead\">{}</div>\n</figure>\n", instead_html);
}

std::string scene_style() {
  return fmt::format("<style>{}</style>\n", embedded::scene_view_css);
}

std::string scene_scripts() {
  return script(embedded::three_js) + script(embedded::orbit_controls_js) + script(embedded::scene_view_js);
}

std::string view_page(const ViewedScene& scene) {
  const std::string heading = fmt::format(
      "<header>\n<p class=\"kicker\">Tanglebin scene</p>\n<h1>{}</h1>\n</header>\n", escaped(scene.name));
  const std::string json = scene_json(scene);
  const std::string figure = scene_figure({json}, still_picture_html(scene));
  return html_document("Tanglebin: " + scene.name, scene_style(),
                       heading + "<main>\n" + figure + "</main>\n" + scene_scripts());
}

}  // namespace tanglebin
