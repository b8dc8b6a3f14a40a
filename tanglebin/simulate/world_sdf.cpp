#include "tanglebin/simulate/world_sdf.hpp"

#include <fmt/core.h>
#include <tinyxml2.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>

#include "tanglebin/base/error.hpp"
#include "tanglebin/cloud/label_colors.hpp"
#include "tanglebin/geometry/bin_parts.hpp"
#include "tanglebin/geometry/mass_properties.hpp"

namespace tanglebin {
namespace {

using tinyxml2::XMLPrinter;

constexpr double unknown_mass_density = 1;   // kg per metre of centre line
constexpr double least_field_of_view = 0.1;  // rad, minimum in SDF's camera.sdf

/// An XML element that lasts until the end of its scope.
class Element {
public:
  Element(XMLPrinter& xml, const char* tag) : xml_(xml) { xml_.OpenElement(tag); }
  Element(XMLPrinter& xml, const char* tag, const std::string& name) : Element(xml, tag) {
    attribute("name", name);
  }
  ~Element() { xml_.CloseElement(); }
  Element(const Element&) = delete;
  Element& operator=(const Element&) = delete;

  void attribute(const char* key, const std::string& value) { xml_.PushAttribute(key, value.c_str()); }

private:
  XMLPrinter& xml_;
};

void write_text(XMLPrinter& xml, const char* tag, const std::string& text) {
  const Element element(xml, tag);
  xml.PushText(text.c_str());
}

// fmt prints the fewest digits that read back as the same double, in any locale.
void write_number(XMLPrinter& xml, const char* tag, double number) {
  write_text(xml, tag, fmt::format("{}", number));
}

void write_vector(XMLPrinter& xml, const char* tag, const Eigen::Vector3d& v) {
  write_text(xml, tag, fmt::format("{} {} {}", v.x(), v.y(), v.z()));
}

// SDF's roll, pitch and yaw are rotations about the fixed axes x, y, z in this order.
void write_pose(XMLPrinter& xml, const Eigen::Vector3d& position, const Eigen::Matrix3d& rotation) {
  const Eigen::Vector3d yaw_pitch_roll = rotation.eulerAngles(2, 1, 0);
  write_text(xml, "pose",
             fmt::format("{} {} {} {} {} {}", position.x(), position.y(), position.z(), yaw_pitch_roll[2],
                         yaw_pitch_roll[1], yaw_pitch_roll[0]));
}

void write_position(XMLPrinter& xml, const Eigen::Vector3d& position) {
  write_text(xml, "pose", fmt::format("{} {} {} 0 0 0", position.x(), position.y(), position.z()));
}

// Appearance and contact of a solid.

void write_material(XMLPrinter& xml, const Color& color) {
  const std::string rgba =
      fmt::format("{:.3f} {:.3f} {:.3f} 1", color[0] / 255.0, color[1] / 255.0, color[2] / 255.0);
  const Element material(xml, "material");
  write_text(xml, "ambient", rgba);
  write_text(xml, "diffuse", rgba);
}

void write_friction(XMLPrinter& xml, double friction) {
  const Element surface(xml, "surface");
  const Element friction_element(xml, "friction");
  const Element ode(xml, "ode");
  write_number(xml, "mu", friction);
  write_number(xml, "mu2", friction);
}

struct Surface {
  Color color;
  double friction;
};

/// A solid, for both collision and display; `write_shape` writes its pose and geometry.
template <typename WriteShape>
void write_solid(XMLPrinter& xml, const std::string& name, const Surface& surface, WriteShape write_shape) {
  {
    const Element collision(xml, "collision", name + "_collision");
    write_shape();
    write_friction(xml, surface.friction);
  }
  const Element visual(xml, "visual", name + "_visual");
  write_shape();
  write_material(xml, surface.color);
}

// The bin.

void write_box(XMLPrinter& xml, const std::string& name, const Eigen::AlignedBox3d& box,
               const Surface& surface) {
  write_solid(xml, name, surface, [&] {
    write_position(xml, box.center());
    const Element geometry(xml, "geometry");
    const Element shape(xml, "box");
    write_vector(xml, "size", box.sizes());
  });
}

void write_bin(XMLPrinter& xml, const Bin& bin, const Color& color) {
  const Element model(xml, "model", "bin");
  write_text(xml, "static", "true");
  const Element link(xml, "link", "body");
  const auto sides = boxes(bin);
  for (std::size_t i = 0; i < sides.size(); ++i) {
    write_box(xml, std::string(bin_part_names.at(i)), sides.at(i), {color, bin.friction});
  }
}

// The camera.

/// SDF's camera frame is x forward, y left, z up; ours is z forward, x right, y down.
Eigen::Matrix3d sdf_camera_rotation(const Camera& camera) {
  const Eigen::Matrix3d optical = camera.pose.linear();
  Eigen::Matrix3d rotation;
  rotation << optical.col(2), -optical.col(0), -optical.col(1);
  return rotation;
}

double horizontal_field_of_view(const Camera& camera) {
  const double hfov = 2 * std::atan(camera.width / (2 * camera.fx));
  if (hfov < least_field_of_view) {
    throw InputError(
        {.file = {}, .line = 0, .field = "scanner"},
        fmt::format("a horizontal field of view of {} rad", hfov),
        fmt::format("at least {} rad, the minimum in SDF; or switch worlds off", least_field_of_view));
  }
  return hfov;
}

double distance_to_farthest_corner(const Eigen::Vector3d& position, const Bin& bin) {
  Eigen::AlignedBox3d box;
  for (const Eigen::AlignedBox3d& side : boxes(bin)) box.extend(side);
  const Eigen::Vector3d from_centre = (position - box.center()).cwiseAbs();
  return (from_centre + box.sizes() / 2).norm();
}

void write_camera(XMLPrinter& xml, const Camera& camera, const Bin& bin) {
  const Element model(xml, "model", "scanner");
  write_text(xml, "static", "true");
  write_pose(xml, camera.pose.translation(), sdf_camera_rotation(camera));
  const Element link(xml, "link", "body");
  Element sensor(xml, "sensor", "depth_camera");
  sensor.attribute("type", "depth");  // understood by both Gazebos
  write_text(xml, "always_on", "false");
  write_number(xml, "update_rate", 1);  // Hz
  const Element camera_element(xml, "camera");
  write_number(xml, "horizontal_fov", horizontal_field_of_view(camera));
  {
    const Element image(xml, "image");
    write_number(xml, "width", camera.width);
    write_number(xml, "height", camera.height);
  }
  const Element clip(xml, "clip");
  const double far = distance_to_farthest_corner(camera.pose.translation(), bin) + 1;  // m
  write_number(xml, "near", far / 100);
  write_number(xml, "far", far);
}

// The tubes.

double known_mass(const Tube& tube) {
  return tube.mass > 0 ? tube.mass : unknown_mass_density * total_length(tube);
}

MassProperties known_mass_properties(Tube tube) {
  tube.mass = known_mass(tube);
  return mass_properties(tube);
}

/// Mass and inertia of a link whose frame is at the centre of mass, along the world's axes.
void write_inertial(XMLPrinter& xml, const MassProperties& properties) {
  const Element inertial(xml, "inertial");
  write_number(xml, "mass", properties.mass);
  const Element inertia(xml, "inertia");
  write_number(xml, "ixx", properties.inertia(0, 0));
  write_number(xml, "ixy", properties.inertia(0, 1));
  write_number(xml, "ixz", properties.inertia(0, 2));
  write_number(xml, "iyy", properties.inertia(1, 1));
  write_number(xml, "iyz", properties.inertia(1, 2));
  write_number(xml, "izz", properties.inertia(2, 2));
}

void write_cylinder(XMLPrinter& xml, const Tube& tube, const Edge& edge, const Eigen::Vector3d& origin,
                    const Surface& surface) {
  const std::string name = fmt::format("e_{}_{}", tube.nodes[edge.from].id, tube.nodes[edge.to].id);
  const EdgeFrame frame = frame_of(tube, edge);
  write_solid(xml, name, surface, [&] {
    write_pose(xml, frame.centre - origin, frame.rotation.toRotationMatrix());
    const Element geometry(xml, "geometry");
    const Element shape(xml, "cylinder");
    write_number(xml, "radius", tube.radius);
    write_number(xml, "length", frame.length);
  });
}

void write_sphere(XMLPrinter& xml, const Tube& tube, const Node& node, const Eigen::Vector3d& origin,
                  const Surface& surface) {
  write_solid(xml, fmt::format("n_{}", node.id), surface, [&] {
    write_position(xml, node.position - origin);
    const Element geometry(xml, "geometry");
    const Element shape(xml, "sphere");
    write_number(xml, "radius", tube.radius);
  });
}

void write_tube(XMLPrinter& xml, const Tube& tube, const Surface& surface) {
  const MassProperties properties = known_mass_properties(tube);
  const Element model(xml, "model", fmt::format("tube_{}", tube.id));
  write_position(xml, properties.centre);
  const Element link(xml, "link", "body");
  write_inertial(xml, properties);
  for (const Edge& edge : tube.edges) write_cylinder(xml, tube, edge, properties.centre, surface);
  const std::vector<bool> is_end = outermost_nodes(tube);
  for (std::size_t i = 0; i < tube.nodes.size(); ++i) {
    const bool is_flat = tube.flat_ends && is_end[i];
    if (!is_flat) write_sphere(xml, tube, tube.nodes[i], properties.centre, surface);
  }
}

// The surroundings.

void write_physics(XMLPrinter& xml, const SettleSettings& settle) {
  Element physics(xml, "physics", "ode");
  physics.attribute("type", "ode");
  write_number(xml, "max_step_size", settle.step);
  write_number(xml, "real_time_factor", 1);
  write_number(xml, "real_time_update_rate", std::round(1 / settle.step));
  const Element ode(xml, "ode");
  {
    const Element solver(xml, "solver");
    write_text(xml, "type", "quick");
    write_number(xml, "iters", settle.iterations_max);
    write_number(xml, "sor", settle.sor);
  }
  const Element constraints(xml, "constraints");
  write_number(xml, "cfm", 0);
  write_number(xml, "erp", settle.erp);
  write_number(xml, "contact_max_correcting_vel", settle.correction_speed);
  write_number(xml, "contact_surface_layer", settle.surface_layer);
}

void write_light(XMLPrinter& xml) {
  Element light(xml, "light", "sun");
  light.attribute("type", "directional");
  write_position(xml, {0, 0, 10});
  write_text(xml, "cast_shadows", "true");
  write_text(xml, "diffuse", "0.8 0.8 0.8 1");
  write_text(xml, "specular", "0.2 0.2 0.2 1");
  write_vector(xml, "direction", {-0.3, 0.2, -0.9});
}

int largest_id(const std::vector<Tube>& tubes) {
  int largest = 0;
  for (const Tube& tube : tubes) largest = std::max(largest, tube.id);
  return largest;
}

}  // namespace

void write_world(std::ostream& out, const std::vector<Tube>& tubes, const Bin& bin, const Camera& camera,
                 const SettleSettings& settle) {
  validate(tubes);
  const std::vector<Color> colors = label_colors(largest_id(tubes));
  XMLPrinter xml;
  xml.PushHeader(false, true);
  {
    Element sdf(xml, "sdf");
    sdf.attribute("version", "1.7");
    const Element world(xml, "world", "tanglebin");
    write_vector(xml, "gravity", {0, 0, -settle.gravity});
    write_physics(xml, settle);
    write_light(xml);
    write_bin(xml, bin, colors.front());
    write_camera(xml, camera, bin);
    for (const Tube& tube : tubes) {
      write_tube(xml, tube, {colors.at(static_cast<std::size_t>(tube.id)), settle.friction});
    }
  }
  out << xml.CStr();
}

}  // namespace tanglebin
