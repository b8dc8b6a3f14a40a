#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include "tanglebin/report/published_figures.hpp"
#include "tanglebin/report/results.hpp"

// Selects the results for a table or a plot.
namespace tanglebin {

/// The runs of a method on a set: a line in a plot.
struct RunGroup {
  std::string set;
  std::string method;
};

/// The distinct values of key(record), ascending.
template <typename Record, typename Key>
auto distinct(const std::vector<Record>& records, const Key& key) {
  std::vector<std::decay_t<decltype(key(records.front()))>> values;
  std::ranges::transform(records, std::back_inserter(values), key);
  std::ranges::sort(values);
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

/// The records for which `is_wanted` holds.
template <typename Record, typename IsWanted>
std::vector<Record> chosen(const std::vector<Record>& records, const IsWanted& is_wanted) {
  std::vector<Record> result;
  std::ranges::copy_if(records, std::back_inserter(result), is_wanted);
  return result;
}

/// value(record) of every record.
template <typename Record, typename Value>
std::vector<double> values(const std::vector<Record>& records, const Value& value) {
  std::vector<double> result;
  std::ranges::transform(records, std::back_inserter(result), value);
  return result;
}

inline int tubes_of(const RunScore& score) {
  return score.run.id.tubes;
}
inline int tubes_of(const RunTime& time) {
  return time.run.id.tubes;
}
inline int tubes_of(const TimesRecord& times) {
  return times.id.tubes;
}

inline std::size_t count_failed(const std::vector<RunScore>& scores) {
  return static_cast<std::size_t>(
      std::ranges::count_if(scores, [](const RunScore& score) { return !score.failure.empty(); }));
}

/// True if a RunScore or RunTime belongs to the group.
template <typename Record>
bool is_of(const Record& record, const RunGroup& group) {
  return record.run.id.set == group.set && record.run.method == group.method;
}

/// The groups of the records, in order of appearance.
template <typename Record>
std::vector<RunGroup> groups_of(const std::vector<Record>& records) {
  std::vector<RunGroup> groups;
  for (const Record& record : records) {
    const auto is_its_group = [&](const RunGroup& group) { return is_of(record, group); };
    if (std::ranges::none_of(groups, is_its_group)) groups.push_back({record.run.id.set, record.run.method});
  }
  return groups;
}

/// The value nearest to `wanted`, of at least one; the smaller of two at the same distance.
template <typename Value>
Value nearest(const std::vector<Value>& ascending, Value wanted) {
  const auto distance = [&](Value value) { return std::abs(static_cast<double>(value - wanted)); };
  return *std::ranges::min_element(ascending, {}, distance);
}

/// The ratio shown in Figure 8 and in the other measures. `scores` must not be empty.
inline double shown_ratio(const std::vector<RunScore>& scores) {
  return nearest(distinct(scores, [](const RunScore& score) { return score.run.ratio; }), figure_8_ratio);
}

/// The number of tubes shown in Figure 9.
inline int shown_tubes(const std::vector<RunScore>& scores) {
  return nearest(distinct(scores, [](const RunScore& score) { return tubes_of(score); }), figure_9_tubes);
}

}  // namespace tanglebin
