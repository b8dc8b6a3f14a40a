#include "tanglebin/model/axis/links.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>
#include <utility>

#include "tanglebin/model/axis/obstacles.hpp"
#include "tanglebin/model/scene/angle.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3d;

constexpr double shortest = 0.002;  // m

LinkFeatures features_of(const FragmentEnd& first, const FragmentEnd& second, double radius) {
  const Vector3d way = second.position - first.position;
  const Vector3d inward = -second.outward;
  const double gap = way.norm();
  const double turn = angle_between(first.outward, inward);
  const double angle = gap < radius ? turn : angle_between(first.outward, way) + angle_between(inward, way);
  return {1, std::log(gap + shortest), gap, angle, angle * angle, turn, 0, 0};
}

/// A possible junction of a fragment: at a node of its centre line, or beyond an end.
struct JunctionPlace {
  LinkTarget target;
  double beyond;  // m
};

LinkFeatures features_of(const FragmentEnd& end, const JunctionPlace& junction) {
  const Vector3d way = junction.target.position - end.position;
  const double gap = way.norm();
  const double angle = angle_between(end.outward, way);
  return {1, std::log(gap + shortest), gap, angle, angle * angle, junction.beyond, 0, 0};
}

std::vector<JunctionPlace> junction_places(const std::vector<Fragment>& fragments, std::size_t of,
                                           double radius, double beyond_max) {
  const Fragment& fragment = fragments[of];
  std::vector<JunctionPlace> places;
  for (std::size_t node = 0; node < fragment.nodes.size(); ++node) {
    places.push_back({{of, node, std::nullopt, fragment.nodes[node]}, 0});
  }
  constexpr double step = 0.4;  // radii
  const int steps = static_cast<int>(beyond_max / step);
  for (std::size_t i = 0; i < fragment.ends.size(); ++i) {
    const auto& [node, position, outward] = fragment.ends[i];
    for (int j = 1; j <= steps; ++j) {
      const double beyond = j * step * radius;
      places.push_back({{of, node, i, position + beyond * outward}, beyond});
    }
  }
  return places;
}

// Indices of features.
constexpr std::size_t alpha = 3;
constexpr std::size_t seen_empty = 6;
constexpr std::size_t obstruction = 7;

double prior(LinkKind kind, const LinkSettings& settings) {
  switch (kind) {
    case LinkKind::chain_ends:
      return settings.chain_prior;
    case LinkKind::tree_ends:
      return settings.tree_prior;
    case LinkKind::junction:
      return settings.junction_prior;
  }
  return 0;
}

double weight_of(const Link& link, const LinkSettings& settings) {
  const LinkFeatures& weights = learned_weights.of(link.kind);
  return prior(link.kind, settings) + ends_taken(link.kind) * std::inner_product(weights.begin(),
                                                                                 weights.end(),
                                                                                 link.features.begin(), 0.0);
}

// The cubic Hermite curve from one end to the other, at t in [0, 1].
Vector3d on_curve(const FragmentEnd& first, const FragmentEnd& second, double t) {
  const double gap = (second.position - first.position).norm();
  const double s = 1 - t;
  return (1 + 2 * t) * s * s * first.position + t * s * s * gap * first.outward +
         t * t * (3 - 2 * t) * second.position + t * t * s * gap * second.outward;
}

// The mean of a non-negative measure over points on the way between two ends: straight or curved, whichever
// is smaller.
template <typename Measure>
double least_mean(const FragmentEnd& first, const FragmentEnd& second, double radius, Measure measure) {
  const Vector3d way = second.position - first.position;
  constexpr double step = 0.4;  // radii
  const int samples = std::clamp(static_cast<int>(way.norm() / (step * radius)) - 1, 1, 16);
  const auto mean = [&](auto place) {
    double sum = 0;
    for (int i = 1; i <= samples; ++i) sum += measure(place(static_cast<double>(i) / (samples + 1)));
    return sum / samples;
  };
  const double straight = mean([&](double t) -> Vector3d { return first.position + t * way; });
  if (straight == 0) return 0;
  return std::min(straight, mean([&](double t) { return on_curve(first, second, t); }));
}

// The fraction of the gap between two ends on which the sensor saw past a tube.
double share_seen_empty(const FragmentEnd& first, const FragmentEnd& second, const RangeImage& seen,
                        double radius) {
  return least_mean(first, second, radius,
                    [&](const Vector3d& axis) { return seen.shows_empty(axis, radius) ? 1.0 : 0.0; });
}

/// Finds the links between two fragments.
class LinkFinder {
public:
  LinkFinder(const std::vector<Fragment>& fragments, const RangeImage& seen, const TubeKind& kind,
             const LinkSettings& settings)
      : fragments_(fragments),
        seen_(seen),
        kind_(kind),
        settings_(settings),
        length_max_(length_max(kind, settings)),
        obstacles_(fragments, kind.radius) {
    if (!kind.branches()) return;
    for (std::size_t i = 0; i < fragments.size(); ++i) {
      places_.push_back(junction_places(fragments, i, kind.radius, settings.beyond_max));
    }
  }

  void between_ends(std::size_t first, std::size_t second) {
    const Fragment& f = fragments_[first];
    const Fragment& g = fragments_[second];
    for (std::size_t i = 0; i < f.ends.size(); ++i) {
      for (std::size_t j = 0; j < g.ends.size(); ++j) {
        const double gap = (g.ends[j].position - f.ends[i].position).norm();
        if (!may_span(gap, f, g)) continue;
        take_if_likely({kind_.branches() ? LinkKind::tree_ends : LinkKind::chain_ends,
                        first,
                        i,
                        {second, g.ends[j].node, j, g.ends[j].position},
                        gap,
                        features_of(f.ends[i], g.ends[j], kind_.radius)},
                       f.ends[i], g.ends[j]);
      }
    }
  }

  // Links to the cheapest junction of the other fragment, with the paper's cost of a join (Section 4).
  void to_junction(std::size_t first, std::size_t second) {
    const Fragment& f = fragments_[first];
    constexpr double metres_for_a_radian = 0.1125;
    for (std::size_t i = 0; i < f.ends.size(); ++i) {
      const FragmentEnd& end = f.ends[i];
      const auto cost = [&](const JunctionPlace& place) {
        const Vector3d way = place.target.position - end.position;
        return way.norm() + place.beyond + metres_for_a_radian * angle_between(end.outward, way);
      };
      const JunctionPlace& cheapest = *std::ranges::min_element(places_[second], {}, cost);
      const Vector3d way_back = end.position - cheapest.target.position;
      if (!may_span(way_back.norm(), f, fragments_[second])) continue;
      take_if_likely(
          {LinkKind::junction, first, i, cheapest.target, way_back.norm(), features_of(end, cheapest)}, end,
          {cheapest.target.node, cheapest.target.position, way_back.normalized()});
    }
  }

  std::vector<Link> found() {
    std::ranges::stable_sort(links_, std::greater<>(), &Link::weight);
    return std::move(links_);
  }

private:
  bool may_span(double gap, const Fragment& first, const Fragment& second) const {
    return first.length + gap + second.length <= length_max_;
  }

  void take_if_likely(Link link, const FragmentEnd& from, const FragmentEnd& to) {
    if (link.features[alpha] > settings_.angle_max || !is_likely(link)) return;
    // Last, because it takes the longest to compute and can only make the link less likely.
    link.features[seen_empty] = share_seen_empty(from, to, seen_, kind_.radius);
    if (link.features[seen_empty] > settings_.seen_empty_max || !is_likely(link)) return;
    link.features[obstruction] = obstruction_of(link, from, to);
    if (is_likely(link)) links_.push_back(link);
  }

  // Weighs a link by the features known so far.
  bool is_likely(Link& link) const {
    link.weight = weight_of(link, settings_);
    return link.weight > 0;
  }

  // Ignores what is near the ends: other pieces of the same tube, and overshoots of a neighbour's centre
  // line.
  double obstruction_of(const Link& link, const FragmentEnd& from, const FragmentEnd& to) const {
    const double diameter = 2 * kind_.radius;
    return std::sqrt(least_mean(from, to, kind_.radius, [&](const Vector3d& axis) {
      const bool is_near_an_end =
          (axis - from.position).norm() < diameter || (axis - to.position).norm() < diameter;
      return is_near_an_end ? 0 : obstacles_.overlap(axis, link.fragment, link.to.fragment);
    }));
  }

  const std::vector<Fragment>& fragments_;
  const RangeImage& seen_;
  const TubeKind& kind_;
  const LinkSettings& settings_;
  double length_max_;  // m
  Obstacles obstacles_;
  std::vector<std::vector<JunctionPlace>> places_;  // of each fragment
  std::vector<Link> links_;
};

}  // namespace

const LinkFeatures& LinkWeights::of(LinkKind kind) const {
  switch (kind) {
    case LinkKind::chain_ends:
      return chain_ends;
    case LinkKind::tree_ends:
      return tree_ends;
    case LinkKind::junction:
      break;
  }
  return junction;
}

double length_max(const TubeKind& kind, const LinkSettings& settings) {
  return kind.length() * (1 + settings.length_tolerance);
}

std::vector<Link> find_links(const std::vector<Fragment>& fragments, const RangeImage& seen,
                             const TubeKind& kind, const LinkSettings& settings) {
  LinkFinder finder(fragments, seen, kind, settings);
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    for (std::size_t j = 0; j < fragments.size(); ++j) {
      if (i < j) finder.between_ends(i, j);
      if (i != j && kind.branches()) finder.to_junction(i, j);
    }
  }
  return finder.found();
}

}  // namespace tanglebin
