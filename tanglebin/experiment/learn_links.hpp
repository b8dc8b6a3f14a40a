#pragma once

#include <vector>

#include "tanglebin/experiment/link_scenes.hpp"

namespace tanglebin {

/// A possible link between two fragments of a scene, and whether a tube really has it.
struct LinkExample {
  LinkKind kind;
  LinkFeatures features;
  bool is_true;
};

/// An end of a fragment, with its possible links; at most one can be chosen.
using EndExample = std::vector<LinkExample>;

/// The ends of all fragments.
std::vector<EndExample> end_examples(const LinkScene& scene);

/// The weights with which the ends are likeliest to choose a true link, or none if none is true: conditional
/// logit (McFadden 1974, "Conditional logit analysis of qualitative choice behavior"), solved by Newton's
/// method with a ridge of 0.001. A longer gap never makes a link likelier: where its weight would be above 0,
/// it is 0, and the others are learned without it. Zero for a kind of link without examples.
LinkWeights likeliest_weights(const std::vector<EndExample>& ends);

/// The weights with which choose_links() finds the true links. They begin as the likeliest_weights() of all
/// ends, which choose alone. Then those of chains are moved until the links that are chosen together have, in
/// sum over the scenes, the features of the true ones: the averaged structured perceptron (Collins 2002,
/// "Discriminative training methods for hidden Markov models"), whose steps are divided by the curvature of
/// the likelihood.
LinkWeights learn_weights(const std::vector<LinkScene>& scenes);

}  // namespace tanglebin
