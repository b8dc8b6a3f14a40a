#pragma once

#include <string>
#include <vector>

#include "tanglebin/geometry/segment.hpp"

namespace tanglebin {

/// A tube's centre line, reduced to the lengths of its segments: one for a chain, several for a tree.
using SegmentTree = std::vector<Segment>;

/// Throws InputError naming `field` if the segments do not form a tree in which every segment but the first
/// starts at a node of an earlier one and ends at a new node. Also if there is no segment, a length is not a
/// finite positive number, or more than twelve segments meet at a node.
void validate(const SegmentTree& tree, const std::string& field);

/// The length of all segments together, m.
double total_length(const SegmentTree& tree);

/// The number of nodes with only one segment.
int count_ends(const SegmentTree& tree);

/// How badly the visible part of a tree fits the known one, m. The minimum, over all ways to lay one on the
/// other, of this sum: by how much segments between junctions are too short or too long; by how much segments
/// to an end are too long (more of them may be hidden); and the length of branches that the known tree does
/// not have.
double misfit(const SegmentTree& seen, const SegmentTree& known);

}  // namespace tanglebin
