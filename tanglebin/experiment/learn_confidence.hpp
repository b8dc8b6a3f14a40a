#pragma once

#include <vector>

#include "tanglebin/dataset/seen_case.hpp"
#include "tanglebin/model/scene/confidence.hpp"
#include "tanglebin/scene/scene.hpp"

namespace tanglebin {

/// A modelled tube, and whether it is one whole true tube, as confidence() has it.
struct TubeExample {
  ConfidenceFeatures features;
  bool is_right;
};

/// The tubes that the axis method finds in a scanner's cloud of a case in the dataset, told this scene in
/// place of what the recipe says. Throws InputError as read_seen_case() and told_scene() do.
std::vector<TubeExample> tube_examples(const Dataset& dataset, const SeenCase& seen, const Scene& told = {});

/// The weights with which the examples are likeliest: logistic regression, solved by Newton's method with a
/// ridge of 0.1.
ConfidenceFeatures learn_confidence(const std::vector<TubeExample>& examples);

}  // namespace tanglebin
