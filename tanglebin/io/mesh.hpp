#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <string_view>
#include <vector>

#include "tanglebin/geometry/tube.hpp"

namespace tanglebin {

/// The surface of a tube as triangles, counterclockwise as seen from outside. It consists of a closed part
/// for each edge: a capsule, without the cap at a flat end. Parts overlap at the nodes.
struct TubeMesh {
  std::int32_t label = 0;
  std::vector<Eigen::Vector3f> vertices;  ///< m
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// The mesh of a tube, of 32 flat sides along it. With flat ends it ends at the outermost nodes; with round
/// ones it has a hemisphere beyond each. The vertices lie on the true surface. Throws InputError as
/// validate(Tube) does.
TubeMesh mesh_of(const Tube& tube);

/// Writes meshes as binary little-endian PLY: vertices with the colours of the labels, and triangles. The
/// caller checks the stream. The file's comment says their unit and frame.
void write_mesh_ply(std::ostream& out, const std::vector<TubeMesh>& meshes,
                    std::string_view unit_and_frame = "metres, world frame");

/// Writes meshes as Wavefront OBJ: an object tube_1, tube_2, … for each.
void write_mesh_obj(std::ostream& out, const std::vector<TubeMesh>& meshes);

}  // namespace tanglebin
