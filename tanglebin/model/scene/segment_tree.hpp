#pragma once

#include <string>
#include <vector>

namespace tanglebin {

/// A stretch of a tube's centre line between two of its named nodes: ends and junctions.
struct TreeSegment {
  int from;
  int to;
  double length;  ///< m
};

/// A tube's centre line by the lengths of its segments alone: one for a chain, more for a tree.
using SegmentTree = std::vector<TreeSegment>;

/// Throws InputError naming `field` for no segment, a length that is not a finite positive number, more than
/// twelve segments at a node, and for a segment that does not start at a node of an earlier one, or ends at
/// one: then it is no tree.
void validate(const SegmentTree& tree, const std::string& field);

/// m, of all segments together.
double total_length(const SegmentTree& tree);

/// Nodes at which one segment alone ends.
int count_ends(const SegmentTree& tree);

/// How badly what is seen of a tree fits the known one, m: the least sum, over all ways to lay the one on the
/// other, of how much its segments between junctions are too short or too long, those to an end, beyond which
/// more may be hidden, too long, and the length of branches that the known tree has not.
double misfit(const SegmentTree& seen, const SegmentTree& known);

}  // namespace tanglebin
