#include "tanglebin/scan/capsule_index.hpp"

#include <embree3/rtcore.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace tanglebin {
namespace {

using Eigen::Vector3d;

// Embree solves a quadratic equation whose leading coefficient is sin² of the angle between ray and axis. In
// single precision it loses hits if that angle is small, and reports none if it is zero. Capsules whose axis
// is closer than this to a ray are always candidates.
constexpr double end_on_angle = 0.05;  // rad

// Embree ignores a round curve whose ends coincide. A capsule much shorter than its radius is always a
// candidate.
constexpr double shortest_length = 0.1;  // radii

/// A radius enlarged so that rounding does not make Embree miss a hit. Let e = 2⁻²⁴, s the sine of the angle
/// between ray and axis, and L the length. Rounding changes the discriminant of Embree's quadratic equation
/// as much as a change of radius² by c e (2 L² + 2 L radius / s), with c less than 10. Rounding of
/// coordinates displaces what lies within `scene_radius` by less than 1e-6 of it. For s > sin(end_on_angle)
/// the enlargement exceeds both.
double radius_for_single_precision(double radius, double length, double scene_radius) {
  return std::sqrt(1.01 * radius * radius + 1e-5 * length * length) + 1e-6 * scene_radius;
}

/// A query with its result.
struct Query : RTCIntersectContext {
  std::vector<std::size_t>* found;
};

/// Embree's filter function: notes the capsule and rejects the hit, so that Embree continues to all others
/// along the ray.
void note_and_reject(const RTCFilterFunctionNArguments* arguments) {
  const auto& query = *static_cast<const Query*>(arguments->context);
  query.found->push_back(RTCHitN_primID(arguments->hit, arguments->N, 0));
  arguments->valid[0] = 0;
}

/// Each capsule has two vertices of its own. Without a neighbour, Embree closes both ends with a sphere.
void add_capsules(RTCDevice device, RTCScene scene, const std::vector<Capsule>& capsules) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE);
  auto* vertex = static_cast<Eigen::Vector4f*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, sizeof(Eigen::Vector4f), 2 * capsules.size()));
  auto* first_vertex = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT, sizeof(unsigned), capsules.size()));
  if (vertex == nullptr || first_vertex == nullptr) throw std::runtime_error("Embree is out of memory");
  for (std::size_t i = 0; i < capsules.size(); ++i) {
    for (const Vector3d& end : {capsules[i].a, capsules[i].b}) {
      *vertex++ = Eigen::Vector4d(end.x(), end.y(), end.z(), capsules[i].radius).cast<float>();
    }
    *first_vertex++ = static_cast<unsigned>(2 * i);
  }
  rtcSetGeometryIntersectFilterFunction(geometry, note_and_reject);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene);
  if (rtcGetDeviceError(device) != RTC_ERROR_NONE) throw std::runtime_error("Embree cannot build a scene");
}

}  // namespace

Eigen::AlignedBox3d bounding_box(const std::vector<Capsule>& capsules) {
  Eigen::AlignedBox3d box;
  for (const Capsule& capsule : capsules) {
    const Vector3d margin = Vector3d::Constant(capsule.radius);
    box.extend(capsule.a.cwiseMin(capsule.b) - margin);
    box.extend(capsule.a.cwiseMax(capsule.b) + margin);
  }
  return box;
}

// Two rays from one point that deviate by an angle are at most distance · sin(angle) apart.
double radius_for_beam(const Capsule& capsule, const BeamShape& beam) {
  const double farthest = std::max((capsule.a - beam.origin).norm(), (capsule.b - beam.origin).norm());
  return capsule.radius + (farthest + capsule.radius) * beam.spread;
}

struct CapsuleIndex::Embree {
  RTCDevice device = rtcNewDevice("threads=1");
  RTCScene scene = nullptr;

  Embree() {
    if (device == nullptr) throw std::runtime_error("Embree cannot create a device");
    scene = rtcNewScene(device);
    // Robust: the traversal of bounding boxes misses none that the ray touches.
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  }
  ~Embree() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
  Embree(const Embree&) = delete;
  Embree& operator=(const Embree&) = delete;
};

CapsuleIndex::CapsuleIndex(const std::vector<Capsule>& capsules, const BeamShape& beam)
    : origin_(beam.origin), centre_(Vector3d::Zero()) {
  if (capsules.empty()) return;
  std::vector<Capsule> thick = capsules;
  for (Capsule& capsule : thick) capsule.radius = radius_for_beam(capsule, beam);
  const Eigen::AlignedBox3d box = bounding_box(thick);
  centre_ = box.center();
  radius_ = box.diagonal().norm() / 2;

  for (std::size_t i = 0; i < thick.size(); ++i) {
    Capsule& capsule = thick[i];
    const double length = (capsule.b - capsule.a).norm();
    if (length < shortest_length * capsule.radius) stubs_.push_back(i);
    axes_.push_back((capsule.b - capsule.a).normalized());
    capsule.radius = radius_for_single_precision(capsule.radius, length, radius_);
    // Near the origin, single-precision coordinates are accurate relative to the scene's size.
    capsule.a -= centre_;
    capsule.b -= centre_;
  }
  embree_ = std::make_unique<Embree>();
  add_capsules(embree_->device, embree_->scene, thick);
}

CapsuleIndex::~CapsuleIndex() = default;

void CapsuleIndex::candidates(const Vector3d& direction, std::vector<std::size_t>& found) const {
  found = stubs_;
  if (embree_ == nullptr) return;
  const double end_on_cosine = std::cos(end_on_angle);
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    if (std::abs(axes_[i].dot(direction)) > end_on_cosine) found.push_back(i);
  }

  // Also for accuracy, Embree's ray starts where it may reach the sphere around all capsules.
  const Vector3d to_centre = centre_ - origin_;
  const double start = std::max(0.0, to_centre.dot(direction) - radius_);
  const Eigen::Vector3f from = (start * direction - to_centre).cast<float>();
  const Eigen::Vector3f along = direction.cast<float>();
  RTCRayHit rayhit{};
  rayhit.ray.org_x = from.x();
  rayhit.ray.org_y = from.y();
  rayhit.ray.org_z = from.z();
  rayhit.ray.dir_x = along.x();
  rayhit.ray.dir_y = along.y();
  rayhit.ray.dir_z = along.z();
  rayhit.ray.tfar = std::numeric_limits<float>::infinity();
  rayhit.ray.mask = ~0U;
  rayhit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  Query query;
  rtcInitIntersectContext(&query);
  query.found = &found;
  rtcIntersect1(embree_->scene, &query, &rayhit);

  // Embree reports both where the ray enters a capsule and where it leaves.
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
}

}  // namespace tanglebin
