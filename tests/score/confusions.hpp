#pragma once

#include <rapidcheck.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tanglebin/scan/scan.hpp"
#include "tanglebin/score/confusion.hpp"
#include "tests/score/integer.hpp"

namespace tanglebin {

/// A label for each point, true and predicted.
struct Labels {
  std::vector<std::int32_t> truth;
  std::vector<std::int32_t> predicted;
};

/// Points counted: a row for each tube, labelled 1, 2, ...; columns for the predicted labels 1, 2, ...
using Counts = std::vector<std::vector<std::int64_t>>;

/// The points of a confusion matrix whose last column is null.
inline Labels labels_with_null(const Counts& counts) {
  Labels labels;
  for (std::size_t row = 0; row < counts.size(); ++row) {
    for (std::size_t column = 0; column < counts[row].size(); ++column) {
      const bool is_null = column + 1 == counts[row].size();
      const auto points = static_cast<std::size_t>(counts[row][column]);
      labels.truth.insert(labels.truth.end(), points, static_cast<std::int32_t>(row + 1));
      labels.predicted.insert(labels.predicted.end(), points,
                              is_null ? null_label : static_cast<std::int32_t>(column + 1));
    }
  }
  return labels;
}

inline Confusion confusion_with_null(const Counts& counts) {
  const Labels labels = labels_with_null(counts);
  return count_overlaps(labels.truth, labels.predicted);
}

/// A confusion matrix without null, whatever the size of its counts.
inline Confusion confusion_of(const Counts& counts, std::size_t columns) {
  Confusion confusion;
  for (std::size_t column = 0; column < columns; ++column) {
    confusion.segments.push_back({static_cast<std::int32_t>(column + 1), 0});
  }
  for (std::size_t row = 0; row < counts.size(); ++row) {
    confusion.tubes.push_back({static_cast<std::int32_t>(row + 1), 0});
    for (std::size_t column = 0; column < columns; ++column) {
      const std::int64_t points = counts[row][column];
      if (points == 0) continue;
      confusion.tubes[row].points += points;
      confusion.segments[column].points += points;
      confusion.overlaps.push_back({row, column, points});
    }
  }
  return confusion;
}

/// 1 to 60 points on up to 6 tubes, with up to 6 predicted labels, bin and null among both.
inline rc::Gen<Labels> any_labels() {
  return rc::gen::exec([] {
    Labels labels;
    const auto points = *integer<std::size_t>(1, 61);
    const auto tubes = *integer(1, 7);
    const auto segments = *integer(0, 7);
    labels.truth = *rc::gen::container<std::vector<std::int32_t>>(points, integer(-1, tubes + 1));
    labels.predicted = *rc::gen::container<std::vector<std::int32_t>>(points, integer(-1, segments + 1));
    labels.truth.front() = 1;
    return labels;
  });
}

}  // namespace tanglebin
