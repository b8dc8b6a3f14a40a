#include "tanglebin/model/paper_method.hpp"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <utility>

#include "tanglebin/model/range_image.hpp"

namespace tanglebin {
namespace {

/// Notes the steps as they end.
class StepClock {
public:
  explicit StepClock(std::vector<Step>& steps) : steps_(steps) {}

  void end_step(std::string name, std::size_t count, std::string of) {
    const auto now = std::chrono::steady_clock::now();
    steps_.push_back(
        {std::move(name), std::chrono::duration<double>(now - start_).count(), count, std::move(of)});
    start_ = now;
  }

private:
  std::vector<Step>& steps_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

std::vector<Cylinder> fit_clusters(const OrientedCloud& cloud,
                                   const std::vector<std::vector<std::size_t>>& clusters, double radius,
                                   const FitSettings& settings) {
  std::vector<Cylinder> cylinders;
  for (const auto& cluster : clusters) {
    std::ranges::move(fit_cylinders(cloud, cluster, radius, settings), std::back_inserter(cylinders));
  }
  return cylinders;
}

// A point of a cylinder has its tube's label, any other that of the nearest cylinder or joint. What the crop
// took away is the bin's.
std::vector<std::int32_t> label_points(const PointCloud& cloud, const std::vector<std::size_t>& cropped,
                                       const PaperModel& found, const std::vector<JoinedTube>& tubes,
                                       const LabelSettings& settings) {
  std::vector<std::int32_t> labels(cloud.points.size(), bin_label);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (!cloud.points[i].allFinite()) labels[i] = null_label;
  }
  for (const std::size_t point : cropped) labels[point] = null_label;
  for (const JoinedTube& joined : tubes) {
    for (const std::size_t cylinder : joined.cylinders) {
      for (const std::size_t point : found.cylinders[cylinder].points) {
        labels[found.filtered.indices[point]] = joined.tube.id;
      }
    }
  }
  std::vector<std::size_t> rest;
  std::ranges::copy_if(cropped, std::back_inserter(rest),
                       [&](std::size_t point) { return labels[point] == null_label; });
  const std::vector<std::int32_t> nearest = label_by_nearest(cloud, rest, found.model.tubes, settings);
  for (std::size_t i = 0; i < rest.size(); ++i) labels[rest[i]] = nearest[i];
  return labels;
}

}  // namespace

PaperModel model_as_in_paper(const PointCloud& cloud, const KnownScene& known, double ratio,
                             std::uint64_t seed, const PaperSettings& settings) {
  PaperModel result;
  Model& model = result.model;
  StepClock clock(model.steps);

  // Section 4, the filtering step: the crop box of Section 6.2, random downsampling, normals.
  const std::vector<std::size_t> cropped = crop(cloud, known.bin, settings.filter);
  model.filtered = downsample(cropped, ratio, seed);
  result.filtered = with_normals(cloud, model.filtered, known.camera.pose.translation(), settings.filter);
  clock.end_step("filter", model.filtered.size(), "points");

  // The segmentation step.
  result.clusters = grow_regions(result.filtered, settings.segment);
  clock.end_step("segment", result.clusters.size(), "clusters");

  // The fitting step.
  result.cylinders = fit_clusters(result.filtered, result.clusters, known.radius, settings.fit);
  clock.end_step("fit", result.cylinders.size(), "cylinders");

  // The joining step.
  const RangeImage seen(cloud, known.camera);
  result.joins = join_cylinders(result.cylinders, seen, known.length, settings.join);
  const std::vector<JoinedTube> tubes = joined_tubes(result.cylinders, result.joins, known.radius);
  for (const JoinedTube& joined : tubes) model.tubes.push_back(joined.tube);
  clock.end_step("join", model.tubes.size(), "tubes");

  // "In order to prepare the labeled point cloud, …"
  model.labels = label_points(cloud, cropped, result, tubes, settings.label);
  clock.end_step("label",
                 static_cast<std::size_t>(std::ranges::count_if(
                     model.labels, [](std::int32_t label) { return label > bin_label; })),
                 "points");
  return result;
}

}  // namespace tanglebin
