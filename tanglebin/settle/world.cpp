#include "tanglebin/settle/world.hpp"

#include <fmt/core.h>
#include <ode/ode.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "tanglebin/base/error.hpp"
#include "tanglebin/geometry/mass_properties.hpp"

namespace tanglebin {
namespace {

void initialize_ode_once() {
  static const int initialized = dInitODE2(0);
  static_cast<void>(initialized);
}

// ODE aborts the process if a mass is not positive.
void require_mass(const Tube& tube) {
  if (std::isfinite(tube.mass) && tube.mass > 0) return;
  throw InputError({"", 0, fmt::format("mass of tube {}", tube.id)}, fmt::format("{}", tube.mass),
                   "a positive number");
}

dMass ode_mass(const MassProperties& properties) {
  const Eigen::Matrix3d& i = properties.inertia;
  dMass mass;
  dMassSetParameters(&mass, properties.mass, 0, 0, 0, i(0, 0), i(1, 1), i(2, 2), i(0, 1), i(0, 2), i(1, 2));
  return mass;
}

void set_offset(dGeomID geom, const Eigen::Vector3d& position, const Eigen::Quaterniond& rotation) {
  const dQuaternion q{rotation.w(), rotation.x(), rotation.y(), rotation.z()};
  dGeomSetOffsetPosition(geom, position.x(), position.y(), position.z());
  dGeomSetOffsetQuaternion(geom, q);
}

Eigen::Vector3d vector(const dReal* v) {
  return {v[0], v[1], v[2]};
}

Eigen::Isometry3d pose(dBodyID body) {
  const dReal* q = dBodyGetQuaternion(body);
  return Eigen::Translation3d(vector(dBodyGetPosition(body))) * Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
}

// ODE's category and collide bits: what may touch what.
constexpr unsigned long tube_bit = 1;
constexpr unsigned long node_bit = 2;
constexpr unsigned long wall_bit = 4;
constexpr unsigned long floor_bit = 8;

void add_bin(dSpaceID space, const Bin& bin) {
  // The floor is a plane, so that nothing can tunnel through it. It contacts a union of capsules at node
  // spheres.
  const dGeomID floor = dCreatePlane(space, 0, 0, 1, 0);
  dGeomSetCategoryBits(floor, floor_bit);
  dGeomSetCollideBits(floor, node_bit);
  const auto parts = boxes(bin);
  for (std::size_t wall = 1; wall < parts.size(); ++wall) {
    const Eigen::Vector3d size = parts[wall].sizes();
    const Eigen::Vector3d centre = parts[wall].center();
    const dGeomID box = dCreateBox(space, size.x(), size.y(), size.z());
    dGeomSetPosition(box, centre.x(), centre.y(), centre.z());
    dGeomSetCategoryBits(box, wall_bit);
    dGeomSetCollideBits(box, tube_bit);
  }
}

struct Body {
  dBodyID id;
  MassProperties properties;
  Tube tube;  // in the body's frame, whose origin is the centre of mass
};

}  // namespace

struct World::Implementation {
  SettleSettings settings;
  double bin_friction;
  dWorldID world;
  dSpaceID space;
  dJointGroupID contacts;
  std::vector<Body> bodies;
  unsigned long random;  // state of ODE's global random generator, restored for each step of this world
  int steps = 0;

  void add_tube(const Tube& tube);
  void touch(dGeomID first, dGeomID second);
};

void World::Implementation::add_tube(const Tube& tube) {
  const MassProperties properties = mass_properties(tube);
  Body body{dBodyCreate(world), properties, tube};
  transform(body.tube, Eigen::Isometry3d(Eigen::Translation3d(-properties.centre)));
  const dMass mass = ode_mass(properties);
  dBodySetMass(body.id, &mass);
  dBodySetLinearDampingThreshold(body.id, 0);
  dBodySetAngularDampingThreshold(body.id, 0);
  dBodySetPosition(body.id, properties.centre.x(), properties.centre.y(), properties.centre.z());

  const dSpaceID parts = dSimpleSpaceCreate(space);
  dGeomSetCategoryBits(reinterpret_cast<dGeomID>(parts), tube_bit);
  dGeomSetCollideBits(reinterpret_cast<dGeomID>(parts), tube_bit | wall_bit);
  const dSpaceID nodes = dSimpleSpaceCreate(space);
  dGeomSetCategoryBits(reinterpret_cast<dGeomID>(nodes), node_bit);
  dGeomSetCollideBits(reinterpret_cast<dGeomID>(nodes), floor_bit);
  const std::vector<Capsule> all = capsules(body.tube);
  std::vector<Eigen::Vector3d> spheres(body.tube.nodes.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Capsule shape = rounded(all[i]);
    spheres[body.tube.edges[i].from] = shape.a;
    spheres[body.tube.edges[i].to] = shape.b;
    const auto [centre, rotation, length] = frame_between(shape.a, shape.b);
    const dGeomID geom = dCreateCapsule(parts, tube.radius, length);
    dGeomSetBody(geom, body.id);
    set_offset(geom, centre, rotation);
  }
  for (const Eigen::Vector3d& sphere : spheres) {
    const dGeomID geom = dCreateSphere(nodes, tube.radius);
    dGeomSetBody(geom, body.id);
    set_offset(geom, sphere, Eigen::Quaterniond::Identity());
  }
  bodies.push_back(std::move(body));
}

void World::Implementation::touch(dGeomID first, dGeomID second) {
  if (dGeomIsSpace(first) != 0 || dGeomIsSpace(second) != 0) {
    dSpaceCollide2(first, second, this,
                   [](void* self, dGeomID a, dGeomID b) { static_cast<Implementation*>(self)->touch(a, b); });
    return;
  }
  const dBodyID first_body = dGeomGetBody(first);
  const dBodyID second_body = dGeomGetBody(second);
  const bool with_bin = first_body == nullptr || second_body == nullptr;

  std::array<dContactGeom, 4> points;
  const int count =
      dCollide(first, second, static_cast<int>(points.size()), points.data(), sizeof(dContactGeom));
  for (int i = 0; i < count; ++i) {
    dContact contact{};
    contact.geom = points[static_cast<std::size_t>(i)];
    contact.surface.mode = dContactApprox1;
    contact.surface.mu = with_bin ? std::min(settings.friction, bin_friction) : settings.friction;
    dJointAttach(dJointCreateContact(world, contacts, &contact), first_body, second_body);
  }
}

World::World(const std::vector<Tube>& tubes, const Bin& bin, const SettleSettings& settings,
             std::uint64_t seed)
    : implementation_(std::make_unique<Implementation>()) {
  for (const Tube& tube : tubes) require_mass(tube);
  initialize_ode_once();
  Implementation& self = *implementation_;
  self.settings = settings;
  self.random = static_cast<unsigned long>(seed & 0xffffffffU);
  self.bin_friction = bin.friction;
  self.world = dWorldCreate();
  self.space = dSimpleSpaceCreate(nullptr);
  self.contacts = dJointGroupCreate(0);
  dWorldSetGravity(self.world, 0, 0, -settings.gravity);
  dWorldSetERP(self.world, settings.erp);
  dWorldSetCFM(self.world, 0);
  dWorldSetQuickStepW(self.world, settings.sor);
  dWorldSetContactSurfaceLayer(self.world, settings.surface_layer);
  dWorldSetContactMaxCorrectingVel(self.world, settings.correction_speed);
  add_bin(self.space, bin);
  for (const Tube& tube : tubes) self.add_tube(tube);
}

World::~World() {
  dJointGroupDestroy(implementation_->contacts);
  dSpaceDestroy(implementation_->space);
  dWorldDestroy(implementation_->world);
}

void World::step(const StepSettings& how) {
  Implementation& self = *implementation_;
  dWorldSetQuickStepNumIterations(self.world, how.iterations);
  for (const Body& body : self.bodies) dBodySetDamping(body.id, how.damping, how.damping);
  dSpaceCollide(self.space, &self,
                [](void* data, dGeomID a, dGeomID b) { static_cast<Implementation*>(data)->touch(a, b); });
  dRandSetSeed(self.random);
  dWorldQuickStep(self.world, self.settings.step);
  self.random = dRandGetSeed();
  dJointGroupEmpty(self.contacts);
  ++self.steps;
}

double World::time() const {
  return implementation_->steps * implementation_->settings.step;
}

double World::fastest_node() const {
  double fastest = 0;
  for (const Body& body : implementation_->bodies) {
    const Eigen::Vector3d linear = vector(dBodyGetLinearVel(body.id));
    const Eigen::Vector3d angular = vector(dBodyGetAngularVel(body.id));
    const Eigen::Matrix3d rotation = pose(body.id).linear();
    for (const Node& node : body.tube.nodes) {
      fastest = std::max(fastest, (linear + angular.cross(rotation * node.position)).norm());
    }
  }
  return fastest;
}

std::vector<Eigen::Vector3d> World::centres_of_mass() const {
  std::vector<Eigen::Vector3d> centres;
  for (const Body& body : implementation_->bodies) centres.push_back(vector(dBodyGetPosition(body.id)));
  return centres;
}

double World::energy() const {
  double energy = 0;
  for (const Body& body : implementation_->bodies) {
    const Eigen::Vector3d linear = vector(dBodyGetLinearVel(body.id));
    const Eigen::Vector3d spin = pose(body.id).linear().transpose() * vector(dBodyGetAngularVel(body.id));
    energy += body.properties.mass * linear.squaredNorm() / 2 + spin.dot(body.properties.inertia * spin) / 2 +
              body.properties.mass * implementation_->settings.gravity * dBodyGetPosition(body.id)[2];
  }
  return energy;
}

std::vector<TubeMotion> World::motions() const {
  std::vector<TubeMotion> motions;
  for (const Body& body : implementation_->bodies) {
    const Eigen::Isometry3d start(Eigen::Translation3d(body.properties.centre));
    motions.push_back({pose(body.id) * start.inverse(), vector(dBodyGetLinearVel(body.id)),
                       vector(dBodyGetAngularVel(body.id))});
  }
  return motions;
}

void World::move_on(const std::vector<TubeMotion>& motions) {
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const dBodyID body = implementation_->bodies[i].id;
    const auto& [moved, linear, angular] = motions[i];
    const Eigen::Isometry3d to = moved * pose(body);
    const Eigen::Vector3d position = to.translation();
    const Eigen::Quaterniond rotation = Eigen::Quaterniond(to.linear()).normalized();
    const dQuaternion q{rotation.w(), rotation.x(), rotation.y(), rotation.z()};
    dBodySetPosition(body, position.x(), position.y(), position.z());
    dBodySetQuaternion(body, q);
    dBodySetLinearVel(body, linear.x(), linear.y(), linear.z());
    dBodySetAngularVel(body, angular.x(), angular.y(), angular.z());
  }
}

std::vector<Tube> World::tubes() const {
  std::vector<Tube> result;
  for (const Body& body : implementation_->bodies) {
    result.push_back(body.tube);
    transform(result.back(), pose(body.id));
  }
  return result;
}

}  // namespace tanglebin
