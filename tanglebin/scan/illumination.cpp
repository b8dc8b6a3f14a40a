#include "tanglebin/scan/illumination.hpp"

#include <algorithm>
#include <cmath>

#include "tanglebin/scan/terms.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3d;

constexpr double negligible = 1e-6;

double drawn(std::uint64_t seed, Term term, std::int32_t label, double least, double greatest) {
  return least + (greatest - least) * random_of(seed, term).uniform(static_cast<std::uint64_t>(label));
}

}  // namespace

Illumination::Illumination(const Surfaces& surfaces, const Camera& camera, const Sensor& sensor,
                           std::uint64_t scene_seed)
    : sensor_(sensor),
      camera_position_(camera.pose.translation()),
      projector_position_(projector_beside(camera, sensor).pose.translation()),
      faintest_mirror_cosine_(std::pow(negligible, 1 / sensor.shininess)) {
  if (sensor.shadows) projector_.emplace(surfaces, camera, sensor);
  materials_[bin_label] = {sensor.bin_albedo, sensor.bin_gloss};
  for (const std::int32_t label : surfaces.labels) {
    materials_[label] = {drawn(scene_seed, Term::albedo, label, sensor.albedo_min, sensor.albedo_max),
                         drawn(scene_seed, Term::gloss, label, sensor.gloss_min, sensor.gloss_max)};
  }
}

double Illumination::snr(const Vector3d& point, const Vector3d& normal, std::int32_t label) {
  if (projector_ && !projector_->lights(point, normal)) return 0;
  return sensor_.signal ? returned(point, normal, materials_.at(label)) : 1;
}

double Illumination::returned(const Vector3d& point, const Vector3d& normal, const Material& material) const {
  const Vector3d to_projector = projector_position_ - point;
  const Vector3d to_camera = camera_position_ - point;
  const double distance = to_projector.norm();
  const double projector_cosine = normal.dot(to_projector) / distance;
  const double camera_cosine = normal.dot(to_camera) / to_camera.norm();
  if (projector_cosine <= 0 || camera_cosine <= 0) return 0;

  const double falloff = sensor_.working_distance * sensor_.working_distance / (distance * distance);
  const double diffuse = material.albedo * projector_cosine * camera_cosine;
  const Vector3d mirrored = 2 * projector_cosine * normal - to_projector / distance;
  const double mirror_cosine = std::min(1.0, mirrored.dot(to_camera) / to_camera.norm());
  const double highlight = mirror_cosine > faintest_mirror_cosine_
                               ? material.gloss * std::pow(mirror_cosine, sensor_.shininess)
                               : 0;
  return sensor_.snr * falloff * (diffuse + highlight);
}

}  // namespace tanglebin
