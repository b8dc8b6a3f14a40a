#include "tanglebin/model/axis/tries.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>

namespace tanglebin {
namespace {

// Whether both found the same lengths, or neither found any.
bool have_same_lengths(const AxisModel& a, const AxisModel& b) {
  constexpr double tolerance = 0.07;  // each is right to half of that
  for (std::size_t i = 0; i < a.kinds.size(); ++i) {
    const TubeKind& kind = a.kinds[i].kind;
    const TubeKind& other = b.kinds[i].kind;
    if ((kind.length_min > 0) != (other.length_min > 0)) return false;
    if (kind.length_min > 0 && std::abs(kind.length() - other.length()) > tolerance * other.length())
      return false;
  }
  return true;
}

}  // namespace

double probably_right(const Model& model) {
  double sum = 0;
  for (const TubeEvidence& tube : model.evidence) sum += tube.confidence * static_cast<double>(tube.points);
  return sum;
}

bool is_in_doubt(const Model& model, double sure_min) {
  constexpr double hopeless = 0.2;
  double points = 0;
  for (const TubeEvidence& tube : model.evidence) points += static_cast<double>(tube.points);
  const double right = probably_right(model);
  return right < sure_min * points && right >= hopeless * points;
}

AxisModel& likeliest_of(std::vector<AxisModel>& tries) {
  const auto rank = [&](const AxisModel& tried) {
    const auto agreeing =
        std::ranges::count_if(tries, [&](const AxisModel& other) { return have_same_lengths(tried, other); });
    return std::pair(2 * agreeing >= std::ssize(tries), probably_right(tried.model));
  };
  return *std::ranges::max_element(tries, {}, rank);
}

}  // namespace tanglebin
