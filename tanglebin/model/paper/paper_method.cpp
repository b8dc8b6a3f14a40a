#include "tanglebin/model/paper/paper_method.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "tanglebin/geometry/labels.hpp"
#include "tanglebin/model/scene/range_image.hpp"
#include "tanglebin/model/scene/step_clock.hpp"
#include "tanglebin/model/scene/weigh.hpp"

namespace tanglebin {
namespace {

std::vector<Cylinder> fit_clusters(const OrientedCloud& cloud,
                                   const std::vector<std::vector<std::size_t>>& clusters, double radius,
                                   const FitSettings& settings, const std::function<void()>& at_step) {
  std::vector<Cylinder> cylinders;
  for (const auto& cluster : clusters) {
    std::ranges::move(fit_cylinders(cloud, cluster, radius, settings), std::back_inserter(cylinders));
    at_step();
  }
  return cylinders;
}

// Gives each tube the points that its cylinders were fitted to.
std::vector<std::int32_t> claimed_points(std::size_t points, const PaperModel& found,
                                         const std::vector<JoinedTube>& tubes) {
  std::vector<std::int32_t> labels(points, null_label);
  for (const JoinedTube& joined : tubes) {
    for (const std::size_t cylinder : joined.cylinders) {
      for (const std::size_t point : found.cylinders[cylinder].points) {
        labels[found.filtered.indices[point]] = joined.tube.id;
      }
    }
  }
  return labels;
}

}  // namespace

void expect_paper_method() {}

PaperModel model_as_in_paper(const PointCloud& cloud, const KnownScene& known, double ratio,
                             std::uint64_t seed, const PaperSettings& settings,
                             const std::function<void()>& at_step) {
  const TubeKind& kind = known.kinds.at(0);
  PaperModel result;
  Model& model = result.model;
  StepClock clock(model.steps, at_step);

  // Section 4, the filtering step: the crop box of Section 6.2, random downsampling, normals.
  const Cropped cropped = crop(cloud, known.support, settings.filter);
  model.filtered = downsample(cropped.kept, ratio, seed);
  result.filtered =
      with_normals(cloud, model.filtered, known.camera.pose.translation(), settings.normal_neighbours);
  clock.end_step("filter", model.filtered.size(), "points");

  // The segmentation step.
  result.clusters = grow_regions(result.filtered, settings.segment);
  clock.end_step("segment", result.clusters.size(), "clusters");

  // The fitting step.
  result.cylinders = fit_clusters(result.filtered, result.clusters, kind.radius, settings.fit, at_step);
  clock.end_step("fit", result.cylinders.size(), "cylinders");

  // The joining step.
  RangeImage seen({}, known.camera);
  for_each_seen(cropped, model.filtered, ratio, seed, [&](std::size_t i) { seen.add(cloud.points[i]); });
  result.joins = join_cylinders(result.cylinders, seen, kind.length(), settings.join);
  const std::vector<JoinedTube> tubes = joined_tubes(result.cylinders, result.joins, kind);
  for (const JoinedTube& joined : tubes) model.tubes.push_back(joined.tube);
  model.evidence.resize(tubes.size());
  clock.end_step("join", model.tubes.size(), "tubes");

  // "In order to prepare the labeled point cloud, …"
  model.labels = label_points(cloud, cropped, claimed_points(cloud.points.size(), result, tubes), model.tubes,
                              settings.label);
  clock.end_step("label",
                 static_cast<std::size_t>(std::ranges::count_if(
                     model.labels, [](std::int32_t label) { return label > bin_label; })),
                 "points");
  weigh(model, cloud, known);
  return result;
}

}  // namespace tanglebin
