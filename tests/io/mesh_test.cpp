#include "tanglebin/io/mesh.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <numbers>
#include <set>
#include <sstream>
#include <string>
#include <utility>

#include "tanglebin/geometry/capsule.hpp"
#include "tests/scan/scene.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;

constexpr double thickness = 0.01;

TubeMesh mesh_with_ends(Tube tube, bool flat) {
  tube.flat_ends = flat;
  return mesh_of(tube);
}

// By the divergence theorem.
double volume_of(const TubeMesh& mesh) {
  double volume = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    volume += mesh.vertices[a].cast<double>().dot(
                  mesh.vertices[b].cast<double>().cross(mesh.vertices[c].cast<double>())) /
              6;
  }
  return volume;
}

// How often each edge is passed in its direction.
std::map<std::pair<std::uint32_t, std::uint32_t>, int> directed_edges(const TubeMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) ++edges[{triangle[i], triangle[(i + 1) % 3]}];
  }
  return edges;
}

std::vector<Tube> some_tubes() {
  return {test::chain(1, thickness, {{0, 0, 0}, {0.2, 0, 0}}),
          test::chain(2, thickness, {{0, 0.1, 0.3}, {0.1, 0.1, 0.35}, {0.2, 0.15, 0.3}}),
          test::chain(3, thickness, {{0, 0, 0.2}, {0, 0, 0.1}, {0, 0, 0.1}})};
}

TEST(Mesh, EveryPartIsClosedAndItsTrianglesFaceOutwards) {
  for (const Tube& tube : some_tubes()) {
    for (const bool flat : {false, true}) {
      const TubeMesh mesh = mesh_with_ends(tube, flat);
      const auto edges = directed_edges(mesh);
      for (const auto& [edge, times] : edges) {
        EXPECT_EQ(times, 1);
        EXPECT_TRUE(edges.contains({edge.second, edge.first}));
      }
      // V − E + F is 2 for each closed part.
      const auto euler = static_cast<std::ptrdiff_t>(mesh.vertices.size()) -
                         static_cast<std::ptrdiff_t>(edges.size() / 2) +
                         static_cast<std::ptrdiff_t>(mesh.triangles.size());
      EXPECT_EQ(euler, 2 * static_cast<std::ptrdiff_t>(tube.edges.size()));
      EXPECT_GT(volume_of(mesh), 0);
    }
  }
}

TEST(Mesh, HasTheVolumeOfItsCapsulesOrOfACylinderIfItsEndsAreFlat) {
  const double pi = std::numbers::pi;
  const double length = 0.2;
  const Tube straight = test::chain(1, thickness, {{0.5, 0.2, 0.1}, {0.5 + length, 0.2, 0.1}});
  const double cylinder = pi * thickness * thickness * length;
  const double ball = 4.0 / 3 * pi * thickness * thickness * thickness;
  constexpr double of_polygons = 0.01;  // what 32 sides lack of a circle
  EXPECT_NEAR(volume_of(mesh_with_ends(straight, false)), cylinder + ball, of_polygons * (cylinder + ball));
  EXPECT_NEAR(volume_of(mesh_with_ends(straight, true)), cylinder, of_polygons * cylinder);
}

TEST(Mesh, LiesOnTheSurface) {
  const Tube tube = some_tubes()[1];
  for (const bool flat : {false, true}) {
    std::set<double> distances;
    const TubeMesh mesh = mesh_with_ends(tube, flat);
    for (const Eigen::Vector3f& vertex : mesh.vertices) {
      double nearest = 1;
      for (const Capsule& part : capsules(tube))
        nearest = std::min(nearest, axis_distance(part, vertex.cast<double>()));
      EXPECT_LT(nearest, thickness + 1e-6);
      distances.insert(nearest);
    }
    EXPECT_NEAR(*distances.rbegin(), thickness, 1e-6);
  }
}

TEST(Mesh, OnlyTheOutermostNodesOfATreeAreFlat) {
  Tube tree = test::chain(1, thickness, {{0, 0, 0}, {0.1, 0, 0}, {0.2, 0, 0}});
  tree.nodes.push_back({4, {0.1, 0.1, 0}});
  tree.edges.push_back({1, 3, 1});
  float least = 0;
  float greatest = 0;
  for (const Eigen::Vector3f& vertex : mesh_with_ends(tree, true).vertices) {
    least = std::min(least, vertex.x());
    greatest = std::max(greatest, vertex.x());
  }
  EXPECT_NEAR(least, 0, 1e-9);
  EXPECT_FLOAT_EQ(greatest, 0.2F);
}

TEST(Mesh, IsWrittenAsPlyWithTheColoursOfTheLabels) {
  std::vector<TubeMesh> meshes;
  for (const Tube& tube : some_tubes()) meshes.push_back(mesh_with_ends(tube, false));
  std::ostringstream out;
  write_mesh_ply(out, meshes);
  const std::string ply = out.str();
  const std::size_t body = ply.find("end_header\n") + std::strlen("end_header\n");
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  for (const TubeMesh& mesh : meshes) {
    vertices += mesh.vertices.size();
    triangles += mesh.triangles.size();
  }
  EXPECT_THAT(ply, HasSubstr("element vertex " + std::to_string(vertices) + "\n"));
  EXPECT_THAT(ply, HasSubstr("element face " + std::to_string(triangles) + "\n"));
  EXPECT_EQ(ply.size(), body + vertices * 15 + triangles * 13);

  const auto whole = [&](std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, ply.data() + at, sizeof value);
    return value;
  };
  // The last triangle is the last of the last mesh.
  const std::size_t before = vertices - meshes.back().vertices.size();
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(whole(ply.size() - 12 + 4 * i), before + meshes.back().triangles.back()[i]);
  }
}

TEST(Mesh, IsWrittenAsObjWithAnObjectForEachTube) {
  std::vector<TubeMesh> meshes;
  for (const Tube& tube : some_tubes()) meshes.push_back(mesh_with_ends(tube, true));
  std::ostringstream out;
  write_mesh_obj(out, meshes);
  EXPECT_THAT(out.str(), HasSubstr("\no tube_3\n"));
  std::istringstream in(out.str());
  std::size_t vertices = 0;
  std::size_t highest = 0;
  for (std::string word; in >> word;) {
    if (word == "v") ++vertices;
    if (word != "f") continue;
    for (int i = 0; i < 3; ++i) {
      std::size_t vertex = 0;
      in >> vertex;
      EXPECT_GE(vertex, 1U);
      highest = std::max(highest, vertex);
    }
  }
  EXPECT_EQ(highest, vertices);
}

TEST(Mesh, OfNoTubesIsEmpty) {
  std::ostringstream ply;
  write_mesh_ply(ply, {});
  EXPECT_THAT(ply.str(), HasSubstr("element face 0\n"));
}

}  // namespace
}  // namespace tanglebin
