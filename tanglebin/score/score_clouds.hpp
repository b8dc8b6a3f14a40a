#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/score/score.hpp"

namespace tanglebin {

/// The ground truth labels of a cloud, from its labels or else its colours: the bin's grey is 0, black is
/// null, and any other colour is a tube. Tubes are numbered in ascending order of red, green, blue. Points
/// without a finite position are null. Throws InputError naming `file` if there are neither labels nor
/// colours, or if there is no tube.
std::vector<std::int32_t> truth_labels(const PointCloud& cloud, const std::string& file);

/// The labels of a labelled cloud. Like truth_labels(), but grey is an ordinary label, and there may be no
/// tube.
std::vector<std::int32_t> predicted_labels(const PointCloud& cloud, const std::string& file);

/// For each point of the ground truth, the entry of `labels` for the point of the labelled cloud at exactly
/// the same position; null if there is none. The labelled cloud may be a subset, in any order. Points at the
/// same position are matched in the order of both clouds; points without a finite position are skipped.
/// Throws InputError naming `file` and the first point that the ground truth does not have.
std::vector<std::int32_t> match_points(const PointCloud& truth, const PointCloud& labelled,
                                       const std::vector<std::int32_t>& labels, const std::string& file);

/// Scores a labelled cloud, with the three functions above and score(). The file names are for messages.
Score score_clouds(const PointCloud& truth, const std::string& truth_file, const PointCloud& labelled,
                   const std::string& labelled_file);

/// Whether the labels that are scored may be the truth's own, left in the file by mistake: they are its
/// colours at every point of the labelled cloud, or its labels, of at least two tubes. (Of one tube, they are
/// often right.) Throws InputError as match_points() does.
bool repeats_truth(const PointCloud& truth, const PointCloud& labelled, const std::string& file);

}  // namespace tanglebin
