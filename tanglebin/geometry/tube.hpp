#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

#include "tanglebin/geometry/capsule.hpp"

namespace tanglebin {

/// A sphere: an end, a joint or a junction of a tube.
struct Node {
  int id;                    ///< unique in its tube; the named nodes (ends, junctions) are 1, 2, …
  Eigen::Vector3d position;  ///< m, world frame
};

/// A cylinder between two nodes.
struct Edge {
  std::size_t from;  ///< index into Tube::nodes
  std::size_t to;    ///< index into Tube::nodes
  int order;         ///< 1, 2, … along its segment
};

/// A tube is a tree of nodes (spheres) and edges (cylinders) of one radius, so its surface is that of a union
/// of capsules (paper, Section 3, with a sphere at every node as in the published data). With flat ends, the
/// capsules that end at an outermost node are cut there.
struct Tube {
  int id = 1;           ///< 1, 2, …; also the label of its points
  double radius = 0.0;  ///< m
  double mass = 0.0;    ///< kg; 0 where it is not known (the text format does not carry it)
  std::vector<Node> nodes;
  std::vector<Edge> edges;
  bool flat_ends = false;  ///< cut flat at the outermost nodes, not rounded beyond them
};

/// Throws InputError naming the field and the tube's id unless it is a tube: an id of 1 or more, a positive
/// radius, positions that are finite, edges between its nodes that make a tree. Functions of other rooms that
/// take tubes of any origin call it, and throw as it does.
void validate(const Tube& tube);
void validate(const std::vector<Tube>& tubes);

/// Checks only the centre lines, which may be in pieces: positions that are finite, edges between nodes.
void validate_lines(const Tube& tube);

/// Where the cylinder of an edge is, which follows from its two nodes.
struct EdgeFrame {
  Eigen::Vector3d centre;       ///< m, the midpoint of the two nodes
  Eigen::Quaterniond rotation;  ///< the shortest that turns +z onto the direction from → to
  double length;                ///< m, the distance of the two nodes
};
EdgeFrame frame_of(const Tube& tube, const Edge& edge);
EdgeFrame frame_between(const Eigen::Vector3d& from, const Eigen::Vector3d& to);

/// The shortest rotation that turns +z onto a unit vector; about x by π for −z.
Eigen::Quaterniond rotation_from_z(const Eigen::Vector3d& direction);

/// For each node, whether it is an end of the tube: it has one edge.
std::vector<bool> outermost_nodes(const Tube& tube);

/// The capsules of all edges, in their order, cut where the tube is.
std::vector<Capsule> capsules(const Tube& tube);

/// The sum of the edges' lengths, m.
double total_length(const Tube& tube);

/// The smallest axis-aligned box around the tube's surface, m.
Eigen::AlignedBox3d bounds(const Tube& tube);

/// Moves the tube as a rigid body.
void transform(Tube& tube, const Eigen::Isometry3d& motion);

/// A number to nine decimals, which the text format holds; never a negative zero.
double to_billionth(double value);

/// Rounds the nodes' positions to whole nanometres, so that the text format holds the tube exactly.
void round_to_nanometres(Tube& tube);

}  // namespace tanglebin
