#include "tanglebin/model/axis/tries.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <tuple>
#include <utility>

#include "tanglebin/base/median.hpp"
#include "tanglebin/geometry/labels.hpp"
#include "tanglebin/model/scene/confidence.hpp"

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

// How many points each tube of one model shares with each tube of the other.
std::vector<std::vector<std::size_t>> shared_points(const Model& a, const Model& b) {
  std::vector<std::vector<std::size_t>> shared(a.tubes.size(), std::vector<std::size_t>(b.tubes.size()));
  for (std::size_t i = 0; i < a.labels.size(); ++i) {
    if (a.labels[i] > bin_label && b.labels[i] > bin_label)
      ++shared[static_cast<std::size_t>(a.labels[i]) - 1][static_cast<std::size_t>(b.labels[i]) - 1];
  }
  return shared;
}

bool are_same(const TubeEvidence& a, const TubeEvidence& b, std::size_t shared) {
  constexpr double overlap_min = 0.9;  // intersection over union
  return static_cast<double>(shared) > overlap_min * static_cast<double>(a.points + b.points - shared);
}

// Visits the tubes of other tries that are the same as one of this try, of which the number is given.
void for_each_same(const AxisModel& of, const std::vector<AxisModel>& tries,
                   const std::function<void(std::size_t, const TubeEvidence&)>& visit) {
  const std::vector<TubeEvidence>& tubes = of.model.evidence;
  for (const AxisModel& tried : tries) {
    if (&tried == &of) continue;
    const std::vector<std::vector<std::size_t>> shared = shared_points(of.model, tried.model);
    for (std::size_t i = 0; i < tubes.size(); ++i) {
      for (std::size_t j = 0; j < shared[i].size(); ++j) {
        const TubeEvidence& other = tried.model.evidence[j];
        if (are_same(tubes[i], other, shared[i][j])) visit(i, other);
      }
    }
  }
}

// Of each tube of a try, the mean over all tries that have it: where voxels begin says nothing of a tube.
std::vector<double> mean_confidences(const AxisModel& of, const std::vector<AxisModel>& tries) {
  std::vector<double> sums;
  std::ranges::transform(of.model.evidence, std::back_inserter(sums), &TubeEvidence::confidence);
  std::vector<double> numbers(sums.size(), 1);
  for_each_same(of, tries, [&](std::size_t tube, const TubeEvidence& other) {
    sums[tube] += other.confidence;
    ++numbers[tube];
  });
  std::ranges::transform(sums, numbers, sums.begin(), std::divides{});
  return sums;
}

// The same as of a model by itself, but as sure as all tries together are.
double probably_right(const AxisModel& tried, const std::vector<AxisModel>& tries) {
  const std::vector<double> confidences = mean_confidences(tried, tries);
  double sum = 0;
  for (std::size_t i = 0; i < confidences.size(); ++i)
    sum += confidences[i] * static_cast<double>(tried.model.evidence[i].points);
  return sum;
}

}  // namespace

double probably_right(const Model& model) {
  double sum = 0;
  for (const TubeEvidence& tube : model.evidence) sum += tube.confidence * static_cast<double>(tube.points);
  return sum;
}

bool is_in_doubt(const Model& model, const FragmentSettings& settings) {
  constexpr double hopeless = 0.5;
  constexpr double too_noisy = 0.3;  // radii
  double points = 0;
  for (const TubeEvidence& tube : model.evidence) points += static_cast<double>(tube.points);
  const double right = probably_right(model);
  const double residual = usual_residual(model);
  return right < settings.sure_min * points && right >= hopeless * points && residual >= settings.noisy_min &&
         residual < too_noisy;
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
    return std::tuple(2 * agreeing >= std::ssize(tries), known_shapes(tried), probably_right(tried, tries));
  };
  // Each is worked out once: it counts the points of all tries.
  std::vector<std::tuple<bool, std::ptrdiff_t, double>> ranks;
  std::ranges::transform(tries, std::back_inserter(ranks), rank);
  return *(tries.begin() + (std::ranges::max_element(ranks) - ranks.begin()));
}

void weigh_by_others(AxisModel& chosen, const std::vector<AxisModel>& tries, const KnownScene& known) {
  if (tries.size() < 2) return;
  std::vector<TubeEvidence>& tubes = chosen.model.evidence;
  std::vector<std::size_t> agreeing(tubes.size());
  for_each_same(chosen, tries, [&](std::size_t tube, const TubeEvidence&) { ++agreeing[tube]; });
  const auto others = static_cast<double>(tries.size() - 1);
  for (std::size_t i = 0; i < tubes.size(); ++i)
    tubes[i].disagreement = 1 - static_cast<double>(agreeing[i]) / others;
  for (TubeEvidence& tube : tubes) tube.confidence = confidence(features_of(tube, known));
}

}  // namespace tanglebin
