#include "tanglebin/experiment/run.hpp"

#include <algorithm>
#include <utility>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/picked.hpp"
#include "tanglebin/base/random.hpp"
#include "tanglebin/dataset/sha256.hpp"
#include "tanglebin/scene/resolve_scene.hpp"
#include "tanglebin/score/score_clouds.hpp"

namespace tanglebin {
namespace {

TubeKind known_kind(const TubeSpec& spec) {
  TubeKind kind{.radius = spec.radius, .segments = {spec.segments.begin(), spec.segments.end()}};
  kind.length_min = kind.length();
  return kind;
}

PointCloud unorganized(std::vector<Eigen::Vector3f> points, std::vector<std::int32_t> labels) {
  PointCloud cloud;
  cloud.points = std::move(points);
  cloud.labels = std::move(labels);
  cloud.width = cloud.points.size();
  return cloud;
}

}  // namespace

std::string case_sha256(const Dataset& dataset, const CaseId& id) {
  return sha256(to_json(dataset.catalogue.record(id)));
}

KnownScene known_scene(const Recipe& recipe, const CaseId& id) {
  KnownScene known{.support = {.bin = recipe.bin}, .camera = recipe.camera, .kinds = {}};
  for (const TubeSpec& spec : set_named(recipe, id.set).kinds) {
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
  return known;
}

KnownScene known_scene(const Recipe& recipe, const CaseData& data, const CaseId& id, const Scene& told) {
  KnownScene known = known_scene(recipe, id);
  if (is_empty(told)) return known;
  Scene scene = overridden(scene_of(known), told);
  scene.camera.frame = CloudFrame::world;
  scene.camera.unit = 1;
  return with_file(data.cloud_file, [&] { return resolve(scene, data.cloud).known; });
}

Model model_case(const KnownScene& known, const CaseData& data, const RunId& run,
                 const ExperimentSettings& settings) {
  const CaseId& id = run.scene;
  ModelSettings model = settings.model;
  model.method = run.method;
  model.ratio = run.ratio;
  constexpr int no_attempt = 0;  // scenes' attempts count from 1, so their seeds differ from the model's
  model.seed = attempt_seed(settings.model.seed, id.set, id.tubes, id.number, no_attempt);
  return with_file(data.cloud_file, [&] { return model_tubes(data.cloud, known, model); });
}

ModelScore score_model(const CaseData& data, const Model& model) {
  const std::vector<std::int32_t> truth = picked(truth_labels(data.cloud, data.cloud_file), model.filtered);
  if (std::ranges::none_of(truth, [](std::int32_t label) { return label > bin_label; })) {
    throw InputError({data.cloud_file, 0, ""}, "no point on a tube is left after filtering");
  }
  return {score(truth, picked(model.labels, model.filtered)), score_tubes(data.tubes, model.tubes)};
}

ComparedClouds compared_clouds(const CaseData& data, const Model& model) {
  const Score labels_score = score_model(data, model).labels;
  std::map<std::int32_t, std::int32_t> shown_as{{bin_label, bin_label}, {null_label, null_label}};
  std::int32_t largest = bin_label;
  for (const Tube& tube : data.tubes) largest = std::max(largest, tube.id);
  for (const TubeScore& tube : labels_score.tubes) {
    if (tube.assigned) shown_as[*tube.assigned] = tube.label;
  }
  for (const Tube& tube : model.tubes) {
    if (!shown_as.contains(tube.id)) shown_as[tube.id] = ++largest;
  }

  const std::vector<Eigen::Vector3f> points = picked(data.cloud.points, model.filtered);
  std::vector<std::int32_t> labels = picked(model.labels, model.filtered);
  for (std::int32_t& label : labels) label = shown_as.at(label);
  return {unorganized(points, picked(truth_labels(data.cloud, data.cloud_file), model.filtered)),
          unorganized(points, std::move(labels))};
}

}  // namespace tanglebin
