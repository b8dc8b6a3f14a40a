#include "tanglebin/pictures/pictures_of_steps.hpp"

#include "tanglebin/base/constants.hpp"
#include "tanglebin/base/picked.hpp"
#include "tanglebin/geometry/labels.hpp"
#include "tanglebin/pictures/picture.hpp"

namespace tanglebin {
namespace {

View nearly_from_above() {
  return {.azimuth = -90 * degree, .elevation = 75 * degree};
}

PointCloud cloud_of(const std::vector<Eigen::Vector3f>& points) {
  PointCloud cloud;
  cloud.points = points;
  cloud.width = points.size();
  return cloud;
}

PointCloud clusters_of(const PaperModel& steps) {
  PointCloud cloud = cloud_of(steps.filtered.points);
  cloud.labels.assign(cloud.points.size(), null_label);
  for (std::size_t i = 0; i < steps.clusters.size(); ++i) {
    for (const std::size_t point : steps.clusters[i]) cloud.labels[point] = static_cast<std::int32_t>(i) + 1;
  }
  return cloud;
}

PointCloud fragments_of(const AxisModel& model) {
  PointCloud cloud;
  std::int32_t fragments = 0;
  for (const AxisSteps& steps : model.kinds) {
    std::vector<std::int32_t> fragment_of(steps.votes.votes.size(), null_label);
    for (const Fragment& fragment : steps.fragments) {
      ++fragments;
      for (const std::size_t point : fragment.points) fragment_of[point] = fragments;
    }
    for (std::size_t i = 0; i < steps.votes.votes.size(); ++i) {
      if (!steps.votes.votes[i].allFinite()) continue;
      cloud.points.push_back(steps.votes.votes[i]);
      cloud.labels.push_back(fragment_of[i]);
    }
  }
  cloud.width = cloud.points.size();
  return cloud;
}

// Leaves out points labelled as the bin.
PointCloud labelled_of(const PointCloud& cloud, const Model& model) {
  PointCloud labelled;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (model.labels[i] == bin_label) continue;
    labelled.points.push_back(cloud.points[i]);
    labelled.labels.push_back(model.labels[i]);
  }
  labelled.width = labelled.points.size();
  return labelled;
}

}  // namespace

std::vector<NamedPicture> pictures_of_steps(const PointCloud& cloud, const PaperModel& steps,
                                            const Support& support, double radius, const std::string& name) {
  std::vector<NamedPicture> pictures;
  if (steps.filtered.points.empty()) return pictures;
  const View view = nearly_from_above();
  pictures.push_back({"1-filtered", picture_of_cloud(cloud_of(steps.filtered.points), view, name)});
  pictures.push_back({"2-segmented", picture_of_cloud(clusters_of(steps), view, name)});
  if (steps.cylinders.empty()) return pictures;
  std::vector<Tube> cylinders;
  for (const JoinedTube& alone : joined_tubes(steps.cylinders, {}, {.radius = radius}))
    cylinders.push_back(alone.tube);
  pictures.push_back({"3-fitted", picture_of_tubes(cylinders, support, view, name)});
  pictures.push_back({"4-joined", picture_of_tubes(steps.model.tubes, support, view, name)});
  pictures.push_back({"5-labelled", picture_of_cloud(labelled_of(cloud, steps.model), view, name)});
  return pictures;
}

std::vector<NamedPicture> pictures_of_steps(const PointCloud& cloud, const AxisModel& steps,
                                            const Support& support, const std::string& name) {
  std::vector<NamedPicture> pictures;
  if (steps.model.tubes.empty()) return pictures;
  const View view = nearly_from_above();
  pictures.push_back(
      {"1-filtered", picture_of_cloud(cloud_of(picked(cloud.points, steps.model.filtered)), view, name)});
  pictures.push_back({"2-votes", picture_of_cloud(fragments_of(steps), view, name)});
  pictures.push_back({"3-joined", picture_of_tubes(steps.model.tubes, support, view, name)});
  pictures.push_back({"4-labelled", picture_of_cloud(labelled_of(cloud, steps.model), view, name)});
  return pictures;
}

}  // namespace tanglebin
