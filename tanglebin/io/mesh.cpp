#include "tanglebin/io/mesh.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <iterator>
#include <numbers>
#include <ostream>
#include <string>

#include "tanglebin/cloud/label_colors.hpp"

namespace tanglebin {
namespace {

constexpr std::size_t sides = 32;
constexpr int rings_of_cap = 8;

/// A circle around an edge, m: how far along it, and its radius.
struct Ring {
  double along;
  double radius;
};

// The rings from one tip to the other, both of which have no radius.
std::vector<Ring> profile(const Capsule& capsule) {
  const double radius = capsule.radius;
  const double length = (capsule.b - capsule.a).norm();
  std::vector<Ring> rings;
  for (int i = capsule.flat_at_a ? rings_of_cap : 1; i <= rings_of_cap; ++i) {
    const double angle = std::numbers::pi / 2 * i / rings_of_cap;
    rings.push_back({-radius * std::cos(angle), radius * std::sin(angle)});
  }
  for (int i = rings_of_cap; i >= (capsule.flat_at_b ? rings_of_cap : 1); --i) {
    const double angle = std::numbers::pi / 2 * i / rings_of_cap;
    rings.push_back({length + radius * std::cos(angle), radius * std::sin(angle)});
  }
  rings.insert(rings.begin(), {capsule.flat_at_a ? 0 : -radius, 0});
  rings.push_back({length + (capsule.flat_at_b ? 0 : radius), 0});
  return rings;
}

void add_part(TubeMesh& mesh, const Capsule& capsule) {
  const std::vector<Ring> rings = profile(capsule);
  const Eigen::Vector3d axis = capsule.b - capsule.a;
  const Eigen::Quaterniond rotation =
      rotation_from_z(axis.norm() > 0 ? axis.normalized() : Eigen::Vector3d::UnitZ());
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  const auto add_vertex = [&](const Ring& ring, std::size_t side) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(side) / sides;
    const Eigen::Vector3d from_a(ring.radius * std::cos(angle), ring.radius * std::sin(angle), ring.along);
    mesh.vertices.emplace_back((capsule.a + rotation * from_a).cast<float>());
  };
  add_vertex(rings.front(), 0);
  for (std::size_t ring = 1; ring + 1 < rings.size(); ++ring) {
    for (std::size_t side = 0; side < sides; ++side) add_vertex(rings[ring], side);
  }
  add_vertex(rings.back(), 0);

  const auto last = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
  const auto circles = static_cast<std::uint32_t>(rings.size() - 2);
  const auto vertex = [&](std::uint32_t circle, std::uint32_t side) {
    return first + 1 + circle * static_cast<std::uint32_t>(sides) + side % static_cast<std::uint32_t>(sides);
  };
  for (std::uint32_t side = 0; side < sides; ++side) {
    mesh.triangles.push_back({first, vertex(0, side + 1), vertex(0, side)});
    for (std::uint32_t circle = 0; circle + 1 < circles; ++circle) {
      mesh.triangles.push_back({vertex(circle, side), vertex(circle, side + 1), vertex(circle + 1, side)});
      mesh.triangles.push_back(
          {vertex(circle, side + 1), vertex(circle + 1, side + 1), vertex(circle + 1, side)});
    }
    mesh.triangles.push_back({vertex(circles - 1, side), vertex(circles - 1, side + 1), last});
  }
}

template <typename Value>
void put(std::string& bytes, const Value& value) {
  static_assert(std::endian::native == std::endian::little, "the files' byte order");
  const auto copy = std::bit_cast<std::array<char, sizeof(Value)>>(value);
  bytes.append(copy.data(), copy.size());
}

// The number of items in all meshes.
template <typename Items>
std::size_t total(const std::vector<TubeMesh>& meshes, Items items) {
  std::size_t sum = 0;
  for (const TubeMesh& mesh : meshes) sum += (mesh.*items).size();
  return sum;
}

}  // namespace

TubeMesh mesh_of(const Tube& tube) {
  validate(tube);
  TubeMesh mesh{.label = tube.id, .vertices = {}, .triangles = {}};
  for (const Capsule& capsule : capsules(tube)) add_part(mesh, capsule);
  return mesh;
}

void write_mesh_ply(std::ostream& out, const std::vector<TubeMesh>& meshes, std::string_view unit_and_frame) {
  std::int32_t largest = 0;
  for (const TubeMesh& mesh : meshes) largest = std::max(largest, mesh.label);
  const std::vector<Color> colors = label_colors(largest);
  std::string ply = fmt::format(
      "ply\n"
      "format binary_little_endian 1.0\n"
      "comment Tanglebin: tubes, {}\n"
      "element vertex {}\n"
      "property float x\n"
      "property float y\n"
      "property float z\n"
      "property uchar red\n"
      "property uchar green\n"
      "property uchar blue\n"
      "element face {}\n"
      "property list uchar uint vertex_indices\n"
      "end_header\n",
      unit_and_frame, total(meshes, &TubeMesh::vertices), total(meshes, &TubeMesh::triangles));
  for (const TubeMesh& mesh : meshes) {
    for (const Eigen::Vector3f& vertex : mesh.vertices) {
      for (const float coordinate : {vertex.x(), vertex.y(), vertex.z()}) put(ply, coordinate);
      put(ply, colors[static_cast<std::size_t>(mesh.label)]);
    }
  }
  std::uint32_t before = 0;
  for (const TubeMesh& mesh : meshes) {
    for (const auto& triangle : mesh.triangles) {
      put(ply, static_cast<std::uint8_t>(triangle.size()));
      for (const std::uint32_t vertex : triangle) put(ply, before + vertex);
    }
    before += static_cast<std::uint32_t>(mesh.vertices.size());
  }
  out.write(ply.data(), static_cast<std::streamsize>(ply.size()));
}

void write_mesh_obj(std::ostream& out, const std::vector<TubeMesh>& meshes) {
  std::string obj = "# Tanglebin: tubes, metres, world frame\n";
  const auto end = std::back_inserter(obj);
  std::uint32_t before = 1;  // OBJ counts vertices from 1
  for (const TubeMesh& mesh : meshes) {
    fmt::format_to(end, "o tube_{}\n", mesh.label);
    for (const Eigen::Vector3f& vertex : mesh.vertices)
      fmt::format_to(end, "v {} {} {}\n", vertex.x(), vertex.y(), vertex.z());
    for (const auto& [a, b, c] : mesh.triangles)
      fmt::format_to(end, "f {} {} {}\n", before + a, before + b, before + c);
    before += static_cast<std::uint32_t>(mesh.vertices.size());
  }
  out.write(obj.data(), static_cast<std::streamsize>(obj.size()));
}

}  // namespace tanglebin
