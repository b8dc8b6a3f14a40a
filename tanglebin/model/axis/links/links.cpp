#include "tanglebin/model/axis/links/links.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "tanglebin/model/scene/angle.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3d;

constexpr double shortest = 0.16;  // radii, added to gaps before their logarithm

double rate(double angle, double gap) {
  constexpr double least = 2;  // radii
  return angle * angle / (gap + least);
}

double seen_to_end(const FragmentEnd& end) {
  return end.hidden == 0 ? 1 : 0;
}

double hidden_beyond(const FragmentEnd& end, double radius) {
  return std::log1p(end.hidden / radius);
}

LinkFeatures features_of(const FragmentEnd& first, const FragmentEnd& second, double radius) {
  const Vector3d way = second.position - first.position;
  const Vector3d inward = -second.outward;
  const double gap = way.norm() / radius;
  const double turn = angle_between(first.outward, inward);
  const double angle = gap < 1 ? turn : angle_between(first.outward, way) + angle_between(inward, way);
  return {1,
          std::log(gap + shortest),
          gap,
          angle,
          angle * angle,
          turn,
          0,
          0,
          rate(angle, gap),
          rate(turn, gap),
          seen_to_end(first) + seen_to_end(second),
          hidden_beyond(first, radius) + hidden_beyond(second, radius)};
}

/// A possible junction of a fragment: at a node of its centre line, or beyond an end.
struct JunctionPlace {
  LinkTarget target;
  double beyond;  // m
};

LinkFeatures features_of(const FragmentEnd& end, const JunctionPlace& junction, double radius) {
  const Vector3d way = junction.target.position - end.position;
  const double gap = way.norm() / radius;
  const double angle = angle_between(end.outward, way);
  return {1,
          std::log(gap + shortest),
          gap,
          angle,
          angle * angle,
          junction.beyond / radius,
          0,
          0,
          rate(angle, gap),
          0,
          seen_to_end(end),
          hidden_beyond(end, radius)};
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
    const FragmentEnd& end = fragment.ends[i];
    for (int j = 1; j <= steps; ++j) {
      const double beyond = j * step * radius;
      places.push_back({{of, end.node, i, end.position + beyond * end.outward}, beyond});
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
  const LinkFeatures& weights = settings.weights.of(link.kind);
  return prior(link.kind, settings) + ends_taken(link.kind) * std::inner_product(weights.begin(),
                                                                                 weights.end(),
                                                                                 link.features.begin(), 0.0);
}

// What its angles add to a link's weight.
double weight_of_angles(const Link& link, const LinkSettings& settings) {
  double sum = 0;
  for (const std::size_t feature : angle_features)
    sum += settings.weights.of(link.kind)[feature] * link.features[feature];
  return ends_taken(link.kind) * sum;
}

// The weight of a link, whether whole chains are bent or not.
double greatest_weight(const Link& link, const LinkSettings& settings) {
  return std::max(link.weight, weight_where_bent(link, settings));
}

// The most that a link may have of a feature that it has none of yet, to weigh more than 0.
double most_of(const Link& link, std::size_t feature, const LinkSettings& settings) {
  const double cost = -ends_taken(link.kind) * settings.weights.of(link.kind)[feature];
  return cost > 0 ? greatest_weight(link, settings) / cost : std::numeric_limits<double>::infinity();
}

std::vector<Link> heaviest_first(std::vector<Link> links) {
  std::ranges::stable_sort(links, std::greater<>(), &Link::weight);
  return links;
}

// The cubic Hermite curve from one end to the other, at t in [0, 1].
Vector3d on_curve(const FragmentEnd& first, const FragmentEnd& second, double t) {
  const double gap = (second.position - first.position).norm();
  const double s = 1 - t;
  return (1 + 2 * t) * s * s * first.position + t * s * s * gap * first.outward +
         t * t * (3 - 2 * t) * second.position + t * t * s * gap * second.outward;
}

/// A way between two ends: places on it, at even steps, without the ends.
using Way = std::vector<Vector3d>;

// The way through place(t), t in [0, 1], over a gap, m.
template <typename Place>
Way way_over(double gap, double radius, const Place& place) {
  constexpr double step = 0.4;  // radii
  const int places = std::clamp(static_cast<int>(gap / (step * radius)) - 1, 1, 16);
  Way way;
  for (int i = 1; i <= places; ++i) way.push_back(place(static_cast<double>(i) / (places + 1)));
  return way;
}

// The mean of a measure, which is at least 0, over the places on a way; none if it is more than `most`, which
// a part of the way may show.
template <typename Measure>
std::optional<double> mean_on(const Way& way, double most, const Measure& measure) {
  const auto places = static_cast<double>(way.size());
  double sum = 0;
  for (const Vector3d& place : way) {
    sum += measure(place);
    if (sum / places > most) return std::nullopt;
  }
  return sum / places;
}

/// Keeps the heaviest of the links that it is given. Of thousands of pieces of noise, nearly any two could be
/// neighbours: that would take time and memory without limit. A heap of sixty tubes has some 14,000 links.
class HeaviestLinks {
public:
  void add(Link link) {
    links_.push_back({std::move(link), added_++});
    if (links_.size() == 2 * most) drop_lightest();
  }

  /// In the order in which they were given.
  std::vector<Link> take() {
    if (links_.size() > most) drop_lightest();
    if (added_ > links_.size()) std::ranges::sort(links_, {}, &Numbered::number);
    std::vector<Link> links;
    links.reserve(links_.size());
    for (Numbered& link : links_) links.push_back(std::move(link.link));
    return links;
  }

private:
  static constexpr std::size_t most = 40'000;

  struct Numbered {
    Link link;
    std::size_t number;  // of those that were given before
  };

  void drop_lightest() {
    const auto end = links_.begin() + most;
    std::ranges::nth_element(links_, end, [](const Numbered& a, const Numbered& b) {
      return std::pair(b.link.weight, a.number) < std::pair(a.link.weight, b.number);
    });
    links_.erase(end, links_.end());
  }

  std::vector<Numbered> links_;
  std::size_t added_ = 0;
};

/// Finds the links between two fragments.
class LinkFinder {
public:
  LinkFinder(const std::vector<Fragment>& fragments, const RangeImage& seen, const TubeKind& kind,
             const LinkSettings& settings, const std::vector<Ball>& others)
      : fragments_(fragments),
        seen_(seen),
        kind_(kind),
        settings_(settings),
        length_max_(length_max(kind.length(), settings)),
        obstacles_(fragments, kind.radius, others) {
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
        consider({kind_.branches() ? LinkKind::tree_ends : LinkKind::chain_ends,
                  first,
                  i,
                  {second, g.ends[j].node, j, g.ends[j].position},
                  gap,
                  features_of(f.ends[i], g.ends[j], kind_.radius)});
      }
    }
  }

  // Links to the cheapest junction of the other fragment, with the paper's cost of a join (Section 4).
  void to_junction(std::size_t first, std::size_t second) {
    const Fragment& f = fragments_[first];
    const double metres_for_a_radian = 9 * kind_.radius;
    for (std::size_t i = 0; i < f.ends.size(); ++i) {
      const FragmentEnd& end = f.ends[i];
      const auto cost = [&](const JunctionPlace& place) {
        const Vector3d way = place.target.position - end.position;
        return way.norm() + place.beyond + metres_for_a_radian * angle_between(end.outward, way);
      };
      const JunctionPlace& cheapest = *std::ranges::min_element(places_[second], {}, cost);
      const Vector3d way_back = end.position - cheapest.target.position;
      if (!may_span(way_back.norm(), f, fragments_[second])) continue;
      consider({LinkKind::junction, first, i, cheapest.target, way_back.norm(),
                features_of(end, cheapest, kind_.radius)});
    }
  }

  std::vector<Link> found() {
    std::vector<Link> links;
    for (const Link& link : considered_.take()) {
      if (std::optional<Link> freest = by_freest_way(link)) links.push_back(*std::move(freest));
    }
    return heaviest_first(std::move(links));
  }

private:
  bool may_span(double gap, const Fragment& first, const Fragment& second) const {
    return first.length + gap + second.length <= length_max_;
  }

  // What lies on the way of a link takes the longest to find out, so that comes last.
  void consider(Link link) {
    link.weight = weight_of(link, settings_);
    if (link.features[alpha] > settings_.angle_max || greatest_weight(link, settings_) <= 0) return;
    considered_.add(std::move(link));
  }

  FragmentEnd target_of(const Link& link, const FragmentEnd& from) const {
    if (link.kind != LinkKind::junction) return fragments_[link.to.fragment].ends[*link.to.end];
    return {link.to.node, link.to.position, (from.position - link.to.position).normalized()};
  }

  // The link by the freer of its ways; none if it is not likely by either.
  std::optional<Link> by_freest_way(const Link& link) const {
    const FragmentEnd& from = fragments_[link.fragment].ends[link.end];
    const FragmentEnd to = target_of(link, from);
    const Vector3d gap = to.position - from.position;
    const auto link_through = [&](const auto& place) {
      return link_by(way_over(gap.norm(), kind_.radius, place), link, from, to);
    };
    std::optional<Link> freest = link_through([&](double t) -> Vector3d { return from.position + t * gap; });
    if (!freest || hindrances(*freest) != std::pair(0.0, 0.0)) {
      const std::optional<Link> curved = link_through([&](double t) { return on_curve(from, to, t); });
      if (curved && (!freest || hindrances(*curved) < hindrances(*freest))) freest = curved;
    }
    return freest;
  }

  // The link with the features of a way; none if it is not likely by that way.
  std::optional<Link> link_by(const Way& way, Link link, const FragmentEnd& from,
                              const FragmentEnd& to) const {
    const double overlap_max = std::pow(most_of(link, obstruction, settings_), 2);
    const std::optional<double> overlap = overlap_on(way, overlap_max, link, from, to);
    if (!overlap) return std::nullopt;
    link.features[obstruction] = std::sqrt(*overlap);
    link.weight = weight_of(link, settings_);
    const double empty_max = std::min(settings_.seen_empty_max, most_of(link, seen_empty, settings_));
    const std::optional<double> empty = mean_on(way, empty_max, [&](const Vector3d& axis) {
      return seen_.shows_empty(axis, kind_.radius) ? 1.0 : 0.0;
    });
    if (!empty) return std::nullopt;
    link.features[seen_empty] = *empty;
    link.weight = weight_of(link, settings_);
    return greatest_weight(link, settings_) > 0 ? std::optional(link) : std::nullopt;
  }

  // What was seen to be empty counts first: there is no tube. The weights do not choose the way, so the
  // weights learned do not depend on those before.
  static std::pair<double, double> hindrances(const Link& link) {
    return {link.features[seen_empty], link.features[obstruction]};
  }

  // The mean overlap with other fragments, if it is no more than `most`. Ignores what is near the ends: other
  // pieces of the same tube, and overshoots of a neighbour's centre line.
  std::optional<double> overlap_on(const Way& way, double most, const Link& link, const FragmentEnd& from,
                                   const FragmentEnd& to) const {
    const double diameter = 2 * kind_.radius;
    return mean_on(way, most, [&](const Vector3d& axis) {
      const bool is_near_an_end =
          (axis - from.position).norm() < diameter || (axis - to.position).norm() < diameter;
      return is_near_an_end ? 0 : obstacles_.overlap(axis, link.fragment, link.to.fragment);
    });
  }

  const std::vector<Fragment>& fragments_;
  const RangeImage& seen_;
  const TubeKind& kind_;
  const LinkSettings& settings_;
  double length_max_;  // m
  Obstacles obstacles_;
  std::vector<std::vector<JunctionPlace>> places_;  // of each fragment
  HeaviestLinks considered_;                        // without what lies on their ways
};

}  // namespace

double length_max(double length, const LinkSettings& settings) {
  return length * (1 + settings.length_tolerance);
}

double weight_where_bent(const Link& link, const LinkSettings& settings) {
  if (link.kind != LinkKind::chain_ends) return link.weight;
  return link.weight - (1 - settings.bent_angles) * weight_of_angles(link, settings);
}

std::vector<Link> likely(const std::vector<Link>& links) {
  return {links.begin(), std::ranges::find_if(links, [](const Link& link) { return link.weight <= 0; })};
}

std::vector<Link> weighed(std::vector<Link> links, const LinkSettings& settings) {
  for (Link& link : links) link.weight = weight_of(link, settings);
  std::erase_if(links, [&](const Link& link) { return greatest_weight(link, settings) <= 0; });
  return heaviest_first(std::move(links));
}

std::vector<Link> find_links(const std::vector<Fragment>& fragments, const RangeImage& seen,
                             const TubeKind& kind, const LinkSettings& settings,
                             const std::vector<Ball>& others) {
  LinkFinder finder(fragments, seen, kind, settings, others);
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    for (std::size_t j = 0; j < fragments.size(); ++j) {
      if (i < j) finder.between_ends(i, j);
      if (i != j && kind.branches()) finder.to_junction(i, j);
    }
  }
  return finder.found();
}

}  // namespace tanglebin
