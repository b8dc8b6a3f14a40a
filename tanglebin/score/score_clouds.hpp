#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/score/score.hpp"

namespace tanglebin {

/// The labels of a cloud of the truth, from its labels, or else from its colours: the bin's grey is 0, black
/// null, every other colour a tube; tubes are numbered in ascending order of red, green, blue. Null where a
/// point has no finite position. Throws InputError naming `file` where there is neither, or no tube.
std::vector<std::int32_t> truth_labels(const PointCloud& cloud, const std::string& file);

/// The labels of a labelled cloud, as truth_labels(), but that grey is a label like any other, and that there
/// need be none.
std::vector<std::int32_t> predicted_labels(const PointCloud& cloud, const std::string& file);

/// For each point of the truth the label, one of `labels`, that the labelled cloud has at exactly this
/// position; null where it has none. The labelled cloud may be a subset in any order; points of the same
/// position are matched in the order of both clouds; points without a finite position are passed over. Throws
/// InputError naming `file` and the first point that the truth lacks.
std::vector<std::int32_t> match_points(const PointCloud& truth, const PointCloud& labelled,
                                       const std::vector<std::int32_t>& labels, const std::string& file);

/// The score of a labelled cloud: the three functions above, then score(). The files' names are for messages.
Score score_clouds(const PointCloud& truth, const std::string& truth_file, const PointCloud& labelled,
                   const std::string& labelled_file);

}  // namespace tanglebin
