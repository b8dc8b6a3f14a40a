#include "tanglebin/model/axis/settings/link_weights.hpp"

namespace tanglebin {
namespace {

auto& weights_of(auto& weights, LinkKind kind) {
  switch (kind) {
    case LinkKind::chain_ends:
      return weights.chain_ends;
    case LinkKind::tree_ends:
      return weights.tree_ends;
    case LinkKind::junction:
      break;
  }
  return weights.junction;
}

}  // namespace

std::string_view name_of(LinkKind kind) {
  switch (kind) {
    case LinkKind::chain_ends:
      return "chain_ends";
    case LinkKind::tree_ends:
      return "tree_ends";
    case LinkKind::junction:
      break;
  }
  return "junction";
}

std::string_view feature_name(LinkKind kind, std::size_t feature) {
  constexpr std::size_t turn = 5;
  if (kind == LinkKind::junction && feature == turn) return "beyond";
  constexpr std::array<std::string_view, link_features> names = {
      "constant",   "log_gap",     "gap",        "angle",     "angle_squared", "turn",
      "seen_empty", "obstruction", "angle_rate", "turn_rate", "seen_ends",     "hidden"};
  return names.at(feature);
}

const LinkFeatures& LinkWeights::of(LinkKind kind) const {
  return weights_of(*this, kind);
}

LinkFeatures& LinkWeights::of(LinkKind kind) {
  return weights_of(*this, kind);
}

}  // namespace tanglebin
