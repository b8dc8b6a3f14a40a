#include "tanglebin/settle/world.hpp"

#include <fmt/core.h>
#include <ode/ode.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include "tanglebin/base/error.hpp"
#include "tanglebin/geometry/mass_properties.hpp"

namespace tanglebin {
namespace {

void initialize_ode_once() {
  static const int initialized = dInitODE2(0);
  static_cast<void>(initialized);
}

void require_within(const Tube& tube, const char* field, double value, double least, double most,
                    const char* unit) {
  if (value >= least && value <= most) return;
  throw InputError({"", 0, fmt::format("{} of tube {}", field, tube.id)}, fmt::format("{}", value),
                   fmt::format("a number from {} to {} {}", least, most, unit));
}

// ODE aborts the process if a mass or an inertia is not positive, or not after rounding.
void require_physical(const Tube& tube) {
  validate(tube);
  require_within(tube, "mass", tube.mass, lightest_tube, heaviest_tube, "kg");
  require_within(tube, "radius", tube.radius, 1e-5, 100, "m");
  require_within(tube, "length", total_length(tube), 1e-6, 100, "m");
  for (const Node& node : tube.nodes) {
    for (const double coordinate : node.position) require_within(tube, "nodes", coordinate, -1000, 1000, "m");
  }
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

// A geom with its bounding box: the lowest and highest x, y and z.
struct Boxed {
  dGeomID geom;
  std::array<dReal, 6> box;
};

Boxed boxed(dGeomID geom) {
  Boxed result{.geom = geom, .box = {}};
  dGeomGetAABB(geom, result.box.data());
  return result;
}

// As ODE compares them.
bool intersect(const Boxed& a, const Boxed& b) {
  return !(a.box[0] > b.box[1] || b.box[0] > a.box[1] || a.box[2] > b.box[3] || b.box[2] > a.box[3] ||
           a.box[4] > b.box[5] || b.box[4] > a.box[5]);
}

// The capsules of a tube in a step, in the order in which ODE has them, and the space of all.
struct Parts {
  Boxed all;
  std::vector<Boxed> capsules;
};

void look_up(dSpaceID space, Parts& parts) {
  parts.all = boxed(reinterpret_cast<dGeomID>(space));
  for (int i = 0; i < dSpaceGetNumGeoms(space); ++i) parts.capsules.push_back(boxed(dSpaceGetGeom(space, i)));
}

const Parts& parts_of(dSpaceID space) {
  Parts& parts = *static_cast<Parts*>(dGeomGetData(reinterpret_cast<dGeomID>(space)));
  if (parts.capsules.empty()) look_up(space, parts);
  return parts;
}

void find_near(const std::vector<Boxed>& capsules, const Boxed& other, std::vector<Boxed>& near) {
  near.clear();
  for (const Boxed& capsule : capsules) {
    if (intersect(capsule, other)) near.push_back(capsule);
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
  std::vector<std::unique_ptr<Parts>> parts;  // of each tube; empty if not yet looked up in this step
  std::vector<Boxed> near_of_first;           // what may touch of two tubes; members to keep their memory
  std::vector<Boxed> near_of_second;

  void add_tube(const Tube& tube);
  void touch(dGeomID first, dGeomID second);
  void touch_tubes(dSpaceID first, dSpaceID second);
  void touch_geoms(dGeomID first, dGeomID second) const;
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

  const dSpaceID capsule_space = dSimpleSpaceCreate(space);
  dGeomSetCategoryBits(reinterpret_cast<dGeomID>(capsule_space), tube_bit);
  dGeomSetCollideBits(reinterpret_cast<dGeomID>(capsule_space), tube_bit | wall_bit);
  dGeomSetData(reinterpret_cast<dGeomID>(capsule_space), parts.emplace_back(std::make_unique<Parts>()).get());
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
    const dGeomID geom = dCreateCapsule(capsule_space, tube.radius, length);
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

// The same pairs in the same order as those of dSpaceCollide2, which tests each capsule of one tube against
// each of the other. Most are not even near the other tube.
void World::Implementation::touch_tubes(dSpaceID first, dSpaceID second) {
  const Parts& a = parts_of(first);
  const Parts& b = parts_of(second);
  find_near(a.capsules, b.all, near_of_first);
  if (near_of_first.empty()) return;
  find_near(b.capsules, a.all, near_of_second);
  const auto touch_if_near = [this](const Boxed& one, const Boxed& other) {
    if (intersect(one, other)) touch_geoms(one.geom, other.geom);
  };
  if (a.capsules.size() < b.capsules.size()) {
    for (const Boxed& one : near_of_first) {
      for (const Boxed& other : near_of_second) touch_if_near(one, other);
    }
  } else {
    for (const Boxed& other : near_of_second) {
      for (const Boxed& one : near_of_first) touch_if_near(one, other);
    }
  }
}

void World::Implementation::touch(dGeomID first, dGeomID second) {
  const bool first_is_space = dGeomIsSpace(first) != 0;
  const bool second_is_space = dGeomIsSpace(second) != 0;
  if (first_is_space && second_is_space) {
    touch_tubes(reinterpret_cast<dSpaceID>(first), reinterpret_cast<dSpaceID>(second));
  } else if (first_is_space || second_is_space) {
    dSpaceCollide2(first, second, this, [](void* self, dGeomID a, dGeomID b) {
      static_cast<Implementation*>(self)->touch_geoms(a, b);
    });
  } else {
    touch_geoms(first, second);
  }
}

void World::Implementation::touch_geoms(dGeomID first, dGeomID second) const {
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
  for (const Tube& tube : tubes) require_physical(tube);
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
  for (const auto& parts : self.parts) parts->capsules.clear();
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

double World::largest_motion(const std::vector<Tube>& start) const {
  double largest = 0;
  for (std::size_t i = 0; i < start.size(); ++i) {
    const Body& body = implementation_->bodies[i];
    const Eigen::Isometry3d to_world = pose(body.id);
    for (std::size_t j = 0; j < start[i].nodes.size(); ++j) {
      const Eigen::Vector3d position = to_world * body.tube.nodes[j].position;
      largest = std::max(largest, (position - start[i].nodes[j].position).norm());
    }
  }
  return largest;
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
