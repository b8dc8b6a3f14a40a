#include "tanglebin/model/axis/tries.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <tuple>
#include <utility>

#include "tanglebin/base/median.hpp"

namespace tanglebin {
namespace {

// Whether both are the same length, or neither is known.
bool have_same_length(const TubeKind& a, const TubeKind& b) {
  constexpr double tolerance = 0.07;  // each is right to half of that
  if ((a.length_min > 0) != (b.length_min > 0)) return false;
  return a.length_min <= 0 || std::abs(a.length() - b.length()) <= tolerance * b.length();
}

bool have_same_lengths(const AxisModel& a, const AxisModel& b) {
  return std::ranges::equal(a.kinds, b.kinds, have_same_length, &AxisSteps::kind, &AxisSteps::kind);
}

// The number of kinds of which it is known what whole tubes look like.
std::ptrdiff_t known_shapes(const AxisModel& tried) {
  return std::ranges::count_if(tried.kinds, &TubeShapes::are_known, &AxisSteps::shapes);
}

// Of the tube that the point in the middle is on, in radii.
double usual_residual(const Model& model) {
  std::vector<std::pair<double, std::size_t>> residuals;
  for (std::size_t i = 0; i < model.tubes.size(); ++i)
    residuals.emplace_back(model.evidence[i].residual / model.tubes[i].radius, model.evidence[i].points);
  return weighted_median(std::move(residuals));
}

}  // namespace

double probably_right(const Model& model) {
  double sum = 0;
  for (const TubeEvidence& tube : model.evidence) sum += tube.confidence * static_cast<double>(tube.points);
  return sum;
}

bool is_in_doubt(const Model& model, const FragmentSettings& settings) {
  constexpr double hopeless = 0.4;
  double points = 0;
  for (const TubeEvidence& tube : model.evidence) points += static_cast<double>(tube.points);
  const double right = probably_right(model);
  return right < settings.sure_min * points && right >= hopeless * points &&
         usual_residual(model) >= settings.noisy_min;
}

TubeShapes shapes_in(const std::vector<AxisModel>& tries, std::size_t number, const TubeKind& kind) {
  for (const AxisModel& tried : tries) {
    const AxisSteps& steps = tried.kinds[number];
    if (steps.shapes.are_known() && have_same_length(steps.kind, kind)) return steps.shapes;
  }
  return {};
}

AxisModel& likeliest_of(std::vector<AxisModel>& tries) {
  const auto rank = [&](const AxisModel& tried) {
    const auto agreeing =
        std::ranges::count_if(tries, [&](const AxisModel& other) { return have_same_lengths(tried, other); });
    return std::tuple(2 * agreeing >= std::ssize(tries), known_shapes(tried), probably_right(tried.model));
  };
  return *std::ranges::max_element(tries, {}, rank);
}

}  // namespace tanglebin
