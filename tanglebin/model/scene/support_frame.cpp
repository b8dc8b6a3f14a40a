#include "tanglebin/model/scene/support_frame.hpp"

#include <utility>

namespace tanglebin {
namespace {

using Eigen::Isometry3d;

Isometry3d frame_of(const KnownScene& known) {
  if (known.support.shape != Support::Shape::nothing) return known.support.pose;
  return Isometry3d(Eigen::Translation3d(known.camera.pose.translation()));
}

}  // namespace

bool is_in_support_frame(const KnownScene& known) {
  return frame_of(known).matrix() == Eigen::Matrix4d::Identity();
}

Seen in_support_frame(const PointCloud& cloud, const KnownScene& known) {
  Seen seen{{}, known};
  const Isometry3d from_world = frame_of(known).inverse(Eigen::Isometry);
  seen.cloud.width = cloud.width;
  seen.cloud.height = cloud.height;
  seen.cloud.points.reserve(cloud.points.size());
  for (const Eigen::Vector3f& point : cloud.points)
    seen.cloud.points.emplace_back((from_world * point.cast<double>()).cast<float>());
  seen.known.camera.pose = from_world * known.camera.pose;
  seen.known.support.pose.setIdentity();
  return seen;
}

Model in_world_frame(Model model, const KnownScene& known) {
  const Isometry3d to_world = frame_of(known);
  for (Tube& tube : model.tubes) transform(tube, to_world);
  for (TubeEvidence& evidence : model.evidence) {
    for (TubeJoin& join : evidence.joins) {
      join.from = to_world * join.from;
      join.to = to_world * join.to;
    }
  }
  return model;
}

}  // namespace tanglebin
