#pragma once

#include <cstddef>
#include <vector>

#include "tanglebin/dataset/dataset.hpp"
#include "tanglebin/model/links.hpp"

namespace tanglebin {

/// A link that there may be between two fragments of a scene, and whether a tube has it.
struct LinkExample {
  LinkKind kind;
  LinkFeatures features;
  bool is_true;
};

/// All links that the axis method considers in the cloud of a case that is there, however unlikely. One is
/// true where most points of both fragments are one tube's, what it joins faces each other along that tube,
/// and no other fragment of the tube is in between. Throws InputError as read_case() does.
std::vector<LinkExample> link_examples(const Dataset& dataset, const CaseId& id);

/// Weights that make the examples of each kind likeliest, by logistic regression (Newton's method with a
/// ridge of 0.001); zero for a kind of which there are none.
LinkWeights learn_weights(const std::vector<LinkExample>& examples);

}  // namespace tanglebin
