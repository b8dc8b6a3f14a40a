#include "tanglebin/experiment/run.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/picked.hpp"
#include "tanglebin/base/random.hpp"
#include "tanglebin/dataset/sha256.hpp"
#include "tanglebin/geometry/labels.hpp"
#include "tanglebin/scene/resolve_scene.hpp"
#include "tanglebin/score/score_clouds.hpp"
#include "tanglebin/score/shown_labels.hpp"

namespace tanglebin {
namespace {

TubeKind known_kind(const TubeSpec& spec) {
  TubeKind kind{.radius = spec.radius, .segments = segments_of(spec), .flat_ends = spec.flat_ends};
  kind.length_min = kind.length();
  return kind;
}

// Chains whose lengths differ from tube to tube: the range of those of the nearest radius.
void widen_lengths(std::vector<TubeKind>& kinds, const std::vector<TubeSpec>& each_tube) {
  for (const TubeSpec& spec : each_tube) {
    const TubeKind tube = known_kind(spec);
    TubeKind& kind = *std::ranges::min_element(
        kinds, {}, [&](const TubeKind& known) { return std::abs(known.radius - tube.radius); });
    if (kind.branches() || tube.branches()) continue;
    kind.segments[0].length = std::max(kind.length(), tube.length());
    kind.length_min = std::min(kind.length_min, tube.length());
  }
}

PointCloud unorganized(std::vector<Eigen::Vector3f> points, std::vector<std::int32_t> labels) {
  PointCloud cloud;
  cloud.points = std::move(points);
  cloud.labels = std::move(labels);
  cloud.width = cloud.points.size();
  return cloud;
}

std::vector<std::int32_t> ids_of(const std::vector<Tube>& tubes) {
  std::vector<std::int32_t> ids;
  ids.reserve(tubes.size());
  for (const Tube& tube : tubes) ids.push_back(tube.id);
  return ids;
}

}  // namespace

std::string case_sha256(const Dataset& dataset, const CaseId& id) {
  return sha256(to_json(dataset.catalogue.record(id)));
}

KnownScene known_scene(const Recipe& recipe, const CaseId& id) {
  if (!recipe.random.empty()) return known_scene(resolve(recipe, id, draw(recipe, id)), id);
  KnownScene known{.support = {.bin = recipe.bin}, .camera = recipe.camera, .kinds = {}};
  const SetRecipe& set = set_named(recipe, id.set);
  for (const TubeSpec& spec : set.kinds) {
    const TubeKind kind = known_kind(spec);
    const auto same = std::ranges::find(known.kinds, kind.radius, &TubeKind::radius);
    if (same == known.kinds.end()) {
      known.kinds.push_back(kind);
      continue;
    }
    const double shortest = std::min(same->length_min, kind.length_min);
    if (std::pair(kind.segments.size(), kind.length()) > std::pair(same->segments.size(), same->length()))
      *same = kind;
    same->length_min = shortest;
  }
  widen_lengths(known.kinds, set.each_tube);
  return known;
}

KnownScene told_scene(const Recipe& recipe, const CaseData& data, const CaseId& id, const Scene& told) {
  KnownScene known = known_scene(recipe, id);
  if (is_empty(told)) return known;
  Scene scene = overridden(scene_of(known), told);
  scene.camera.frame = CloudFrame::world;
  scene.camera.unit = 1;
  return with_file(data.cloud_file, [&] { return resolve(scene, data.cloud).known; });
}

std::uint64_t model_seed(const ExperimentSettings& settings, const CaseId& id) {
  constexpr int no_attempt = 0;  // scenes' attempts count from 1, so their seeds differ from the model's
  return attempt_seed(settings.model.seed, id.set, id.tubes, id.number, no_attempt);
}

Model model_case(const KnownScene& known, const CaseData& data, const RunId& run,
                 const ExperimentSettings& settings) {
  ModelSettings model = settings.model;
  model.method = method_named(run.method);
  model.ratio = run.ratio;
  model.seed = model_seed(settings, run.scene);
  return with_file(data.cloud_file, [&] { return model_tubes(data.cloud, known, model); });
}

ModelScore score_model(const CaseData& data, const Model& model, bool has_tubes) {
  const std::vector<std::int32_t> truth = picked(truth_labels(data.cloud, data.cloud_file), model.filtered);
  if (!has_tube(truth))
    throw InputError({data.cloud_file, 0, ""}, "no point on a tube is left after filtering");
  const std::vector<std::uint8_t> mixed =
      data.cloud.mixed.empty() ? std::vector<std::uint8_t>{} : picked(data.cloud.mixed, model.filtered);
  ModelScore found{score(truth, picked(model.labels, model.filtered), mixed), std::nullopt};
  if (has_tubes) found.tubes = score_tubes(data.tubes, model.tubes);
  return found;
}

ComparedClouds compared_clouds(const CaseData& data, const Model& model) {
  const std::vector<Eigen::Vector3f> points = picked(data.cloud.points, model.filtered);
  std::vector<std::int32_t> labels = picked(model.labels, model.filtered);
  std::set<std::int32_t> found(labels.begin(), labels.end());
  for (const std::int32_t id : ids_of(model.tubes)) found.insert(id);
  const std::map<std::int32_t, std::int32_t> shown_as =
      shown_labels(score_model(data, model, false).labels, ids_of(data.tubes), {found.begin(), found.end()});
  for (std::int32_t& label : labels) label = shown_as.at(label);
  return {unorganized(points, picked(truth_labels(data.cloud, data.cloud_file), model.filtered)),
          unorganized(points, std::move(labels))};
}

}  // namespace tanglebin
