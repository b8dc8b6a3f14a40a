#include "tanglebin/report/published_figures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace tanglebin {
namespace {

struct Table1Row {
  int tubes;
  double set_a;
  double set_b;
};

constexpr std::array<Table1Row, 16> table_1 = {{
    {1, 3.13, 2.68},
    {2, 6.32, 5.84},
    {3, 8.86, 7.39},
    {4, 8.77, 7.57},
    {5, 8.25, 8.90},
    {6, 11.41, 9.21},
    {7, 10.39, 9.81},
    {8, 10.58, 10.75},
    {9, 10.82, 10.95},
    {10, 14.20, 13.73},
    {11, 14.95, 13.45},
    {12, 16.54, 15.48},
    {13, 14.53, 15.85},
    {14, 16.16, 16.81},
    {15, 16.73, 16.78},
    {20, 28.10, 25.02},
}};

constexpr std::array<int, 5> table_2_tubes = {1, 5, 10, 15, 20};

struct Table2Row {
  double ratio;
  std::array<double, 5> seconds;
};

constexpr std::array<Table2Row, 10> table_2 = {{
    {0.1, {0.19, 0.32, 0.48, 0.60, 0.78}},
    {0.2, {0.19, 0.41, 0.69, 0.90, 1.23}},
    {0.3, {0.21, 0.49, 0.85, 1.19, 1.69}},
    {0.4, {0.23, 0.55, 1.02, 1.43, 2.06}},
    {0.5, {0.24, 0.61, 1.12, 1.69, 2.37}},
    {0.6, {0.26, 0.68, 1.25, 1.90, 2.50}},
    {0.7, {0.27, 0.73, 1.40, 2.21, 2.81}},
    {0.8, {0.29, 0.82, 1.56, 2.43, 3.11}},
    {0.9, {0.31, 0.88, 1.54, 2.71, 3.38}},
    {1.0, {0.32, 0.91, 1.65, 2.84, 3.66}},
}};

// "an approximate value of 0.867" for one tube, "increased by approximately 3.9% from 1 to 2 tubes" and
// "decreased by approximately 4.1% from 1 to 10 tubes".
constexpr double set_b_one_tube = 0.867;
constexpr double set_b_two_tubes = set_b_one_tube * 1.039;
constexpr double set_b_ten_tubes = set_b_one_tube * 0.959;

}  // namespace

std::optional<double> published_generation_time(std::string_view set, int tubes) {
  const auto* const row = std::ranges::find(table_1, tubes, &Table1Row::tubes);
  if (row == table_1.end()) return std::nullopt;
  if (set == "A") return row->set_a;
  if (set == "B") return row->set_b;
  return std::nullopt;
}

std::optional<double> published_modelling_time(std::string_view set, int tubes, double ratio) {
  // Ratios computed in steps of 0.1 may differ from those written here in the last bit.
  const auto is_row = [&](const Table2Row& row) { return std::abs(row.ratio - ratio) < 1e-9; };
  const auto* const row = std::ranges::find_if(table_2, is_row);
  const auto* const column = std::ranges::find(table_2_tubes, tubes);
  if (set != "A" || row == table_2.end() || column == table_2_tubes.end()) return std::nullopt;
  return row->seconds[static_cast<std::size_t>(column - table_2_tubes.begin())];
}

std::optional<double> published_micro_recall(std::string_view set, int tubes) {
  if (set != "B") return std::nullopt;
  if (tubes == 1) return set_b_one_tube;
  if (tubes == 2) return set_b_two_tubes;
  if (tubes == 10) return set_b_ten_tubes;
  return std::nullopt;
}

}  // namespace tanglebin
