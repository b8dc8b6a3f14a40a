#include <pybind11/operators.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "arrays.hpp"
#include "tanglebin/geometry/bin.hpp"
#include "tanglebin/geometry/camera.hpp"
#include "tanglebin/geometry/support.hpp"
#include "tanglebin/geometry/tube.hpp"
#include "tanglebin/io/mesh.hpp"

namespace tanglebin::python {
namespace {

using Indices = std::vector<std::array<std::size_t, 2>>;

std::vector<std::vector<std::size_t>> edges_at_nodes(const Tube& tube) {
  std::vector<std::vector<std::size_t>> edges(tube.nodes.size());
  for (std::size_t i = 0; i < tube.edges.size(); ++i) {
    edges[tube.edges[i].from].push_back(i);
    edges[tube.edges[i].to].push_back(i);
  }
  return edges;
}

// The nodes from `node` along `edge` to the next end or junction.
std::vector<std::size_t> walk(const Tube& tube, const std::vector<std::vector<std::size_t>>& edges,
                              std::size_t node, std::size_t edge) {
  std::vector<std::size_t> path{node};
  while (true) {
    node = tube.edges[edge].from == node ? tube.edges[edge].to : tube.edges[edge].from;
    path.push_back(node);
    if (edges[node].size() != 2 || node == path.front()) return path;
    edge = edges[node][0] == edge ? edges[node][1] : edges[node][0];
  }
}

py::array_t<double> positions(const Tube& tube, const std::vector<std::size_t>& path) {
  py::array_t<double> points({signed_size(path.size()), py::ssize_t{3}});
  for (std::size_t i = 0; i < path.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) points.mutable_at(i, axis) = tube.nodes[path[i]].position[axis];
  }
  return points;
}

// What Python has written into a tube's arrays may be anything.
double valid_length(const Tube& tube) {
  validate(tube);
  return total_length(tube);
}

std::vector<py::array_t<double>> centre_lines(const Tube& tube) {
  validate(tube);
  const std::vector<std::vector<std::size_t>> edges = edges_at_nodes(tube);
  std::vector<py::array_t<double>> lines;
  for (std::size_t node = 0; node < edges.size(); ++node) {
    if (edges[node].size() == 2) continue;
    for (const std::size_t edge : edges[node]) {
      const std::vector<std::size_t> path = walk(tube, edges, node, edge);
      if (path.front() < path.back()) lines.push_back(positions(tube, path));  // each from one of its ends
    }
  }
  return lines;
}

Indices chain_of(std::size_t nodes) {
  Indices edges;
  for (std::size_t i = 1; i < nodes; ++i) edges.push_back({i - 1, i});
  return edges;
}

// The ends of a chain are the named nodes 1 and 2.
int id_in_chain(std::size_t node, std::size_t nodes) {
  if (node == 0) return 1;
  return node + 1 == nodes ? 2 : static_cast<int>(node) + 2;
}

Tube tube_of(const py::array_t<double, py::array::c_style | py::array::forcecast>& nodes, double radius,
             int id, double mass, const std::optional<Indices>& edges, bool flat_ends) {
  expect_shape(nodes.ndim() == 2 && nodes.shape(1) == 3 && nodes.shape(0) >= 2, nodes, "nodes",
               "n x 3, of two nodes or more");
  const auto count = static_cast<std::size_t>(nodes.shape(0));
  Tube tube{.id = id, .radius = radius, .mass = mass, .nodes = {}, .edges = {}, .flat_ends = flat_ends};
  for (std::size_t i = 0; i < count; ++i) {
    tube.nodes.push_back({edges ? static_cast<int>(i) + 1 : id_in_chain(i, count),
                          {nodes.at(i, 0), nodes.at(i, 1), nodes.at(i, 2)}});
  }
  for (const auto& [from, to] : edges.value_or(chain_of(count)))
    tube.edges.push_back({from, to, static_cast<int>(tube.edges.size()) + 1});
  validate(tube);
  return tube;
}

py::tuple tube_state(const Tube& tube) {
  py::list nodes;
  for (const Node& node : tube.nodes)
    nodes.append(py::make_tuple(node.id, node.position.x(), node.position.y(), node.position.z()));
  py::list edges;
  for (const Edge& edge : tube.edges) edges.append(py::make_tuple(edge.from, edge.to, edge.order));
  return py::make_tuple(tube.id, tube.radius, tube.mass, nodes, edges, tube.flat_ends);
}

Tube tube_from(const py::tuple& state) {
  Tube tube{.id = state[0].cast<int>(),
            .radius = state[1].cast<double>(),
            .mass = state[2].cast<double>(),
            .nodes = {},
            .edges = {},
            .flat_ends = state[5].cast<bool>()};
  for (const auto& [id, x, y, z] : state[3].cast<std::vector<std::tuple<int, double, double, double>>>())
    tube.nodes.push_back({id, {x, y, z}});
  for (const auto& [from, to, order] :
       state[4].cast<std::vector<std::tuple<std::size_t, std::size_t, int>>>())
    tube.edges.push_back({from, to, order});
  return tube;
}

void bind_tube(py::module_& module) {
  py::class_<Tube>(module, "Tube", doc::geometry::Tube)
      .def(py::init(&tube_of), py::arg("nodes"), py::arg("radius"), py::arg("id") = 1, py::arg("mass") = 0.0,
           py::arg("edges") = py::none(), py::arg("flat_ends") = false,
           "A tube along nodes (n x 3, m), a chain unless `edges` has the pairs of indices that are "
           "connected.")
      .def_readwrite("id", &Tube::id, doc::geometry::Tube_id)
      .def_readwrite("radius", &Tube::radius, doc::geometry::Tube_radius)
      .def_readwrite("mass", &Tube::mass, doc::geometry::Tube_mass)
      .def_readwrite("flat_ends", &Tube::flat_ends, doc::geometry::Tube_flat_ends)
      .def_property_readonly(
          "nodes",
          [](const py::object& self) {
            auto& nodes = self.cast<Tube&>().nodes;
            return rows(nodes, nodes.empty() ? nullptr : nodes.front().position.data(), 3, self);
          },
          "The nodes' positions, n x 3, m, world frame; in the tube's memory.")
      .def_property_readonly(
          "node_ids",
          [](const py::object& self) {
            auto& nodes = self.cast<Tube&>().nodes;
            return view(nodes.empty() ? nullptr : &nodes.front().id, {signed_size(nodes.size())},
                        {sizeof(Node)}, self);
          },
          doc::geometry::Node_id)
      .def_property_readonly(
          "edges",
          [](const py::object& self) {
            auto& edges = self.cast<Tube&>().edges;
            return rows(edges, edges.empty() ? nullptr : &edges.front().from, 2, self);
          },
          "The indices of the nodes that each edge connects, m x 2; in the tube's memory.")
      .def_property_readonly(
          "centre_lines", &centre_lines,
          "The centre line, m, world frame: an array k x 3 for each run of edges between ends and "
          "junctions, which is one for a chain. Copies.")
      .def_property_readonly("length", &valid_length, doc::geometry::total_length)
      .def(
          "transformed",
          [](Tube tube, const py::array_t<double>& motion) {
            transform(tube, pose_of(motion, "motion"));
            return tube;
          },
          py::arg("motion"), "A copy of the tube, moved as a rigid body by a 4 x 4 matrix.")
      .def(py::pickle(&tube_state, &tube_from))
      .def("__repr__", [](const Tube& tube) {
        return fmt::format("<Tube {}: {} nodes, radius {} m, length {:.4g} m>", tube.id, tube.nodes.size(),
                           tube.radius, valid_length(tube));
      });

  py::class_<TubeMesh>(module, "TubeMesh", tanglebin::doc::io::TubeMesh)
      .def_readonly("label", &TubeMesh::label, "of the tube")
      .def_property_readonly(
          "vertices",
          [](const py::object& self) {
            auto& vertices = self.cast<TubeMesh&>().vertices;
            return rows(vertices, vertices.empty() ? nullptr : vertices.front().data(), 3, self);
          },
          "n x 3 float32, m; in the mesh's memory.")
      .def_property_readonly(
          "triangles",
          [](const py::object& self) {
            auto& triangles = self.cast<TubeMesh&>().triangles;
            return rows(triangles, triangles.empty() ? nullptr : triangles.front().data(), 3, self);
          },
          "The indices of each triangle's vertices, m x 3 uint32; in the mesh's memory.");
  module.def("mesh_of", &mesh_of, py::arg("tube"), tanglebin::doc::io::mesh_of);
}

py::tuple camera_state(const Camera& camera) {
  return py::make_tuple(camera.width, camera.height, camera.fx, camera.fy, camera.cx, camera.cy,
                        matrix_of(camera.pose));
}

Camera camera_of(int width, int height, double fx, double fy, double cx, double cy,
                 const std::optional<py::array_t<double>>& pose) {
  Camera camera{.width = width, .height = height, .fx = fx, .fy = fy, .cx = cx, .cy = cy};
  if (pose) camera.pose = pose_of(*pose, "pose");
  validate(camera);
  return camera;
}

void bind_camera(py::module_& module) {
  py::class_<Intrinsics>(module, "Intrinsics", doc::geometry::Intrinsics)
      .def(py::init<int, int, double, double, double, double>(), py::arg("width"), py::arg("height"),
           py::arg("fx"), py::arg("fy"), py::arg("cx"), py::arg("cy"))
      .def_readwrite("width", &Intrinsics::width, doc::geometry::Intrinsics_width)
      .def_readwrite("height", &Intrinsics::height, doc::geometry::Intrinsics_height)
      .def_readwrite("fx", &Intrinsics::fx, doc::geometry::Intrinsics_fx)
      .def_readwrite("fy", &Intrinsics::fy, doc::geometry::Intrinsics_fx)
      .def_readwrite("cx", &Intrinsics::cx, doc::geometry::Intrinsics_cx)
      .def_readwrite("cy", &Intrinsics::cy, doc::geometry::Intrinsics_cx)
      .def(py::self == py::self);
  py::class_<Camera>(module, "Camera", doc::geometry::Camera)
      .def(py::init(&camera_of), py::arg("width"), py::arg("height"), py::arg("fx"), py::arg("fy"),
           py::arg("cx"), py::arg("cy"), py::arg("pose") = py::none())
      .def_readwrite("width", &Camera::width, doc::geometry::Camera_width)
      .def_readwrite("height", &Camera::height, doc::geometry::Camera_height)
      .def_readwrite("fx", &Camera::fx, doc::geometry::Camera_fx)
      .def_readwrite("fy", &Camera::fy, doc::geometry::Camera_fx)
      .def_readwrite("cx", &Camera::cx, doc::geometry::Camera_cx)
      .def_readwrite("cy", &Camera::cy, doc::geometry::Camera_cx)
      .def_property(
          "pose", [](const Camera& camera) { return matrix_of(camera.pose); },
          [](Camera& camera, const py::array_t<double>& pose) { camera.pose = pose_of(pose, "pose"); },
          doc::geometry::Camera_pose)
      .def_property_readonly("intrinsics", &intrinsics_of, doc::geometry::Intrinsics)
      .def(py::self == py::self)
      .def(py::pickle([](const Camera& camera) { return camera_state(camera); },
                      [](const py::tuple& state) {
                        return camera_of(state[0].cast<int>(), state[1].cast<int>(), state[2].cast<double>(),
                                         state[3].cast<double>(), state[4].cast<double>(),
                                         state[5].cast<double>(), state[6].cast<py::array_t<double>>());
                      }));
  module.def("camera_preset", &camera_preset, py::arg("name"), doc::geometry::camera_preset);
  module.def(
      "downward_camera",
      [](int width, int height, double focal_length_px, const py::array_t<double>& position) {
        return downward_camera(width, height, focal_length_px, vector_of(position, "position"));
      },
      py::arg("width"), py::arg("height"), py::arg("focal_length_px"), py::arg("position"),
      doc::geometry::downward_camera);
  module.def("focal_length_from_hfov", &focal_length_from_hfov, py::arg("width"), py::arg("hfov"),
             doc::geometry::focal_length_from_hfov);
}

void bind_support(py::module_& module) {
  py::class_<Bin>(module, "Bin", doc::geometry::Bin)
      .def(py::init([](double length, double width, double height, double wall, double friction) {
             return Bin{length, width, height, wall, friction};
           }),
           py::arg("length") = Bin{}.length, py::arg("width") = Bin{}.width, py::arg("height") = Bin{}.height,
           py::arg("wall") = Bin{}.wall, py::arg("friction") = Bin{}.friction)
      .def_readwrite("length", &Bin::length, doc::geometry::Bin_length)
      .def_readwrite("width", &Bin::width, doc::geometry::Bin_width)
      .def_readwrite("height", &Bin::height, doc::geometry::Bin_height)
      .def_readwrite("wall", &Bin::wall, doc::geometry::Bin_wall)
      .def_readwrite("friction", &Bin::friction, doc::geometry::Bin_friction)
      .def(py::self == py::self)
      .def(py::pickle(
          [](const Bin& bin) {
            return py::make_tuple(bin.length, bin.width, bin.height, bin.wall, bin.friction);
          },
          [](const py::tuple& state) {
            return Bin{state[0].cast<double>(), state[1].cast<double>(), state[2].cast<double>(),
                       state[3].cast<double>(), state[4].cast<double>()};
          }));
  module.def("bin_preset", &bin_preset, py::arg("name"), doc::geometry::bin_preset);

  py::class_<Support>(module, "Support", doc::geometry::Support)
      .def(py::init([](const std::string& shape, const Bin& bin,
                       const std::optional<py::array_t<double>>& pose, double margin) {
             Support support{.shape = shape_named(shape), .bin = bin, .margin = margin};
             if (pose) support.pose = pose_of(*pose, "support.pose");
             validate(support);
             return support;
           }),
           py::arg("shape") = "bin", py::arg_v("bin", Bin{}, "Bin()"), py::arg("pose") = py::none(),
           py::arg("margin") = 0.0, "The shape is \"bin\", \"plane\" or \"nothing\".")
      .def_property(
          "shape", [](const Support& support) { return name_of(support.shape); },
          [](Support& support, const std::string& name) { support.shape = shape_named(name); },
          "\"bin\", \"plane\" or \"nothing\"")
      .def_readwrite("bin", &Support::bin, doc::geometry::Support_bin)
      .def_property(
          "pose", [](const Support& support) { return matrix_of(support.pose); },
          [](Support& support, const py::array_t<double>& pose) {
            support.pose = pose_of(pose, "support.pose");
          },
          doc::geometry::Support_pose)
      .def_readwrite("margin", &Support::margin, doc::geometry::Support_margin);
}

}  // namespace

void bind_geometry(py::module_& module) {
  bind_support(module);
  bind_camera(module);
  bind_tube(module);
}

}  // namespace tanglebin::python
