#include "tanglebin/score/score_clouds.hpp"

#include <fmt/core.h>

#include <boost/container_hash/hash.hpp>
#include <cstddef>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>

#include "tanglebin/base/error.hpp"
#include "tanglebin/cloud/label_colors.hpp"
#include "tanglebin/geometry/labels.hpp"

namespace tanglebin {
namespace {

using ColorLabels = std::map<Color, std::int32_t>;

// Many colours are a picture's, and stand for no tubes.
constexpr std::size_t most_colors = 2000;

std::vector<std::int32_t> number_colors(const std::vector<Color>& colors, ColorLabels label_of,
                                        const std::string& file) {
  const std::set<Color> distinct(colors.begin(), colors.end());
  if (distinct.size() > most_colors)
    throw InputError(
        {file, 0, ""}, fmt::format("no labels, but {} colours", distinct.size()),
        fmt::format("a label for each point, or at most {} colours, one for each tube", most_colors));
  std::int32_t next_label = 1;
  for (const Color& color : distinct) {
    if (label_of.try_emplace(color, next_label).second) ++next_label;
  }
  std::vector<std::int32_t> labels;
  labels.reserve(colors.size());
  for (const Color& color : colors) labels.push_back(label_of.at(color));
  return labels;
}

std::vector<std::int32_t> labels_of(const PointCloud& cloud, const ColorLabels& known_colors,
                                    const std::string& file) {
  if (cloud.labels.size() == cloud.points.size()) return cloud.labels;
  if (cloud.colors.size() == cloud.points.size()) return number_colors(cloud.colors, known_colors, file);
  throw InputError({file, 0, ""}, "neither labels nor colours", "a label or a colour for each point");
}

struct PositionHash {
  std::size_t operator()(const Eigen::Vector3f& position) const {
    std::size_t hash = 0;
    // Unlike the bits, std::hash is the same for 0 and -0, which are equal.
    for (const float coordinate : position) boost::hash_combine(hash, std::hash<float>{}(coordinate));
    return hash;
  }
};

/// The points of a cloud by position. Each can be taken once.
class PointsByPosition {
public:
  explicit PointsByPosition(const std::vector<Eigen::Vector3f>& points) : next_(points.size(), none) {
    first_.reserve(points.size());
    // Backwards, so that points at the same position are taken in order.
    for (std::size_t i = points.size(); i-- > 0;) {
      if (!points[i].allFinite()) continue;
      const auto [entry, is_new] = first_.try_emplace(points[i], i);
      if (!is_new) next_[i] = std::exchange(entry->second, i);
    }
  }

  bool knows(const Eigen::Vector3f& position) const { return first_.contains(position); }

  /// The next point at this position; none after the last.
  std::optional<std::size_t> take(const Eigen::Vector3f& position) {
    const auto entry = first_.find(position);
    if (entry == first_.end() || entry->second == none) return std::nullopt;
    return std::exchange(entry->second, next_[entry->second]);
  }

private:
  static constexpr std::size_t none = SIZE_MAX;
  std::unordered_map<Eigen::Vector3f, std::size_t, PositionHash> first_;
  std::vector<std::size_t> next_;  // for each point, the next one at the same position
};

std::vector<std::int32_t> numbers_of(const std::vector<Color>& colors) {
  std::vector<std::int32_t> numbers;
  numbers.reserve(colors.size());
  for (const auto& [red, green, blue] : colors) numbers.push_back(red << 16 | green << 8 | blue);
  return numbers;
}

bool has_several_tubes(const std::vector<std::int32_t>& labels) {
  const std::set<std::int32_t> all(labels.begin(), labels.end());
  return std::distance(all.upper_bound(bin_label), all.end()) > 1;
}

std::string to_string(const Eigen::Vector3f& point) {
  return fmt::format("({}, {}, {})", point.x(), point.y(), point.z());
}

}  // namespace

std::vector<std::int32_t> truth_labels(const PointCloud& cloud, const std::string& file) {
  const Color bin_color = label_colors(0).front();
  std::vector<std::int32_t> labels =
      labels_of(cloud, {{bin_color, bin_label}, {null_color, null_label}}, file);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (!cloud.points[i].allFinite()) labels[i] = null_label;
  }
  if (!has_tube(labels)) throw InputError({file, 0, ""}, "no point on a tube", "at least one to score");
  return labels;
}

std::vector<std::int32_t> predicted_labels(const PointCloud& cloud, const std::string& file) {
  return labels_of(cloud, {{null_color, null_label}}, file);
}

std::vector<std::int32_t> match_points(const PointCloud& truth, const PointCloud& labelled,
                                       const std::vector<std::int32_t>& labels, const std::string& file) {
  PointsByPosition truth_points(truth.points);
  std::vector<std::int32_t> matched(truth.points.size(), null_label);
  for (std::size_t i = 0; i < labelled.points.size(); ++i) {
    const Eigen::Vector3f& position = labelled.points[i];
    if (!position.allFinite()) continue;
    const auto point = truth_points.take(position);
    if (!point) {
      throw InputError({file, 0, fmt::format("point {}", i + 1)}, to_string(position),
                       truth_points.knows(position) ? "no more points at this position than in the truth"
                                                    : "the exact position of a point in the truth");
    }
    matched[*point] = labels[i];
  }
  return matched;
}

Score score_clouds(const PointCloud& truth, const std::string& truth_file, const PointCloud& labelled,
                   const std::string& labelled_file) {
  const auto truth_of_points = truth_labels(truth, truth_file);
  const auto labels = predicted_labels(labelled, labelled_file);
  return score(truth_of_points, match_points(truth, labelled, labels, labelled_file), truth.mixed);
}

bool repeats_truth(const PointCloud& truth, const PointCloud& labelled, const std::string& file) {
  const bool is_by_label = !labelled.labels.empty();
  const auto of_truth = is_by_label ? truth.labels : numbers_of(truth.colors);
  const auto of_labelled = is_by_label ? labelled.labels : numbers_of(labelled.colors);
  if (of_truth.empty() || of_labelled.empty()) return false;
  if (is_by_label && !has_several_tubes(of_labelled)) return false;
  constexpr std::int32_t is_there = 1;
  const auto matched = match_points(truth, labelled, of_labelled, file);
  const auto there =
      match_points(truth, labelled, std::vector<std::int32_t>(of_labelled.size(), is_there), file);
  for (std::size_t i = 0; i < matched.size(); ++i) {
    if (there[i] == is_there && matched[i] != of_truth[i]) return false;
  }
  return true;
}

}  // namespace tanglebin
