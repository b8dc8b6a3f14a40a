#include "tanglebin/model/length_check.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <numbers>
#include <optional>
#include <string>

namespace tanglebin {
namespace {

using Eigen::Vector3d;

std::string in_metres(double value) {
  return fmt::format("{:.3g} m", value);
}

/// An outermost node of a tube.
struct TubeEnd {
  std::size_t tube;   ///< index into Model::tubes
  Vector3d position;  ///< m, world frame
  Vector3d outward;   ///< unit vector along the tube, away from it
};

/// A kind's length, as it was told or estimated.
struct KindLength {
  double min = 0;  ///< m; 0 if it is not known
  double max = 0;  ///< m; infinite if it is not known
  bool is_estimated = false;
};

/// What became of the tubes whose kinds' lengths were all told, or all estimated.
struct Tally {
  std::size_t tubes = 0;
  std::size_t complete = 0;
  std::size_t too_short = 0;  // but for those that may go on outside of the image
  std::size_t too_long = 0;
  std::size_t cuts = 0;
  double shortest = std::numeric_limits<double>::infinity();  // m
  double longest = 0;                                         // m

  bool are_many_too_long() const { return share * too_long > tubes; }
  bool are_many_too_short() const { return too_short >= tubes_min && too_short > share * complete; }
  bool are_many_cut() const { return cuts >= cuts_min && share * cuts > tubes; }
  bool is_doubtful() const { return are_many_too_long() || are_many_too_short() || are_many_cut(); }

private:
  static constexpr std::size_t share = 5;
  static constexpr std::size_t tubes_min = 3;
  static constexpr std::size_t cuts_min = 2;
};

/// Compares the tubes' lengths with what is known of them.
class LengthCheck {
public:
  LengthCheck(const KnownScene& known, const Model& model) : known_(known), model_(model) {
    for (const TubeKind& kind : known.kinds) kinds_.push_back({kind.length_min, kind.length(), false});
    for (const auto& [kind, length] : model.estimated_lengths) kinds_[kind] = {length, length, true};
  }

  std::vector<Finding> doubts() const {
    std::vector<Finding> doubts;
    for (const bool is_estimated : {false, true}) {
      const Tally tally = tally_of(is_estimated);
      if (!tally.is_doubtful()) continue;
      doubts.push_back({Finding::Severity::warning, "length",
                        is_estimated ? doubt_of_estimated(tally) : doubt_of_told(tally)});
    }
    return doubts;
  }

private:
  const KindLength& kind_of(std::size_t tube) const { return kinds_[model_.evidence[tube].kind]; }

  bool is_at_border(const Vector3d& position, double radius) const {
    constexpr double near = 2;  // radii
    const Camera& camera = known_.camera;
    const auto at = project(camera, position);
    if (!at) return true;
    const double margin = near * radius * camera.fx / depth_of(camera, position);
    return at->x() < margin || at->x() > camera.width - 1 - margin || at->y() < margin ||
           at->y() > camera.height - 1 - margin;
  }

  // Outermost nodes have one edge. Short edges do not tell the direction well.
  std::vector<TubeEnd> ends_of(std::size_t index) const {
    const Tube& tube = model_.tubes[index];
    std::vector<std::vector<std::size_t>> next(tube.nodes.size());
    for (const Edge& edge : tube.edges) {
      next[edge.from].push_back(edge.to);
      next[edge.to].push_back(edge.from);
    }
    std::vector<TubeEnd> ends;
    for (std::size_t end = 0; end < next.size(); ++end) {
      if (next[end].size() != 1) continue;
      const Vector3d& position = tube.nodes[end].position;
      std::size_t before = end;
      std::size_t at = next[end].front();
      while ((tube.nodes[at].position - position).norm() < 2 * tube.radius && next[at].size() == 2) {
        const std::size_t after = next[at].front() == before ? next[at].back() : next[at].front();
        before = at;
        at = after;
      }
      ends.push_back({index, position, (position - tube.nodes[at].position).normalized()});
    }
    return ends;
  }

  // Where a tube ends at the image's border, it may go on.
  bool may_go_on(std::size_t tube) const {
    return std::ranges::any_of(ends_of(tube), [&](const TubeEnd& end) {
      return is_at_border(end.position, model_.tubes[tube].radius);
    });
  }

  // Whether a tube that was cut here would leave these two ends: near each other, in line, and of tubes that
  // are together too long for one.
  bool is_cut(const TubeEnd& a, const TubeEnd& b) const {
    constexpr double gap_max = 4;   // radii
    constexpr double side_max = 1;  // radii
    constexpr double too_long = 1.05;
    const double cos_bend_max = std::cos(40 * std::numbers::pi / 180);
    const std::size_t kind = model_.evidence[a.tube].kind;
    if (a.tube == b.tube || kind != model_.evidence[b.tube].kind || known_.kinds[kind].branches())
      return false;
    const double radius = model_.tubes[a.tube].radius;
    const Vector3d gap = b.position - a.position;
    const double along = gap.dot(a.outward);
    const double together = model_.evidence[a.tube].length + model_.evidence[b.tube].length;
    return gap.norm() < gap_max * radius && along > 0 &&
           (gap - along * a.outward).norm() < side_max * radius && a.outward.dot(b.outward) < -cos_bend_max &&
           together > too_long * kinds_[kind].max;
  }

  std::size_t cuts_of(bool is_estimated) const {
    std::vector<TubeEnd> ends;
    for (std::size_t i = 0; i < model_.tubes.size(); ++i) {
      if (kind_of(i).is_estimated == is_estimated) std::ranges::move(ends_of(i), std::back_inserter(ends));
    }
    std::size_t cuts = 0;
    for (auto a = ends.begin(); a != ends.end(); ++a) {
      if (std::any_of(ends.begin(), a, [&](const TubeEnd& b) { return is_cut(*a, b); })) ++cuts;
    }
    return cuts;
  }

  Tally tally_of(bool is_estimated) const {
    Tally tally{.cuts = cuts_of(is_estimated)};
    for (std::size_t i = 0; i < model_.tubes.size(); ++i) {
      if (kind_of(i).is_estimated != is_estimated) continue;
      const double length = model_.evidence[i].length;
      const LengthFit fit = model_.evidence[i].length_fit;
      ++tally.tubes;
      if (fit == LengthFit::complete) ++tally.complete;
      if (fit == LengthFit::too_short && !may_go_on(i)) ++tally.too_short;
      if (fit == LengthFit::too_long) ++tally.too_long;
      tally.shortest = std::min(tally.shortest, length);
      tally.longest = std::max(tally.longest, length);
    }
    return tally;
  }

  // "0.2 m", "0.2 to 0.3 m or at most 0.5 m"
  std::string lengths_of_kinds(bool is_estimated) const {
    constexpr double same = 0.999;
    std::string text;
    for (const auto& [min, max, estimated] : kinds_) {
      if (estimated != is_estimated || std::isinf(max)) continue;
      const std::string least = min == 0           ? "at most "
                                : min < same * max ? fmt::format("{:.3g} to ", min)
                                                   : "";
      text += (text.empty() ? "" : " or ") + least + in_metres(max);
    }
    return text;
  }

  // "14 of 18 tubes are shorter than known and 2 longer"
  static std::string words_of_numbers(const Tally& tally, const std::string& known) {
    const std::string all = fmt::format("of {} tubes are", tally.tubes);
    if (tally.too_short == 0 && tally.too_long == 0)
      return fmt::format("of {} tubes, some look cut in two", tally.tubes);
    if (tally.too_short == 0) return fmt::format("{} {} longer than {}", tally.too_long, all, known);
    if (tally.too_long == 0) return fmt::format("{} {} shorter than {}", tally.too_short, all, known);
    return tally.too_short > tally.too_long ? fmt::format("{} {} shorter than {} and {} longer",
                                                          tally.too_short, all, known, tally.too_long)
                                            : fmt::format("{} {} longer than {} and {} shorter",
                                                          tally.too_long, all, known, tally.too_short);
  }

  static std::string words_of_cuts(const Tally& tally) {
    if (!tally.are_many_cut()) return "";
    return fmt::format(
        "; {} times, two lie end to end in line and are together longer than that, as one that was cut in "
        "two",
        tally.cuts);
  }

  // A tube that is cut in two is no reason to tell a smaller length.
  std::string doubt_of_told(const Tally& tally) const {
    const bool do_differ = std::min(tally.too_short, tally.too_long) > 1;
    return fmt::format(
        "{}: {:.3g} to {} long, and {} is known{}: is the length {}?{}", words_of_numbers(tally, "known"),
        tally.shortest, in_metres(tally.longest), lengths_of_kinds(false), words_of_cuts(tally),
        tally.are_many_cut() ? "too small" : "right",
        do_differ || tally.are_many_cut()
            ? " If the tubes differ in length, give its range: length = { min, max } in [[tube]]"
            : "");
  }

  std::string doubt_of_estimated(const Tally& tally) const {
    return fmt::format(
        "{}: {:.3g} to {} long, and the length was estimated as {}, because none was told{}: tell it, or its "
        "range: --length, or length in [[tube]]",
        words_of_numbers(tally, "estimated"), tally.shortest, in_metres(tally.longest),
        lengths_of_kinds(true), words_of_cuts(tally));
  }

  const KnownScene& known_;
  const Model& model_;
  std::vector<KindLength> kinds_;
};

}  // namespace

std::vector<Finding> doubts_of_lengths(const KnownScene& known, const Model& model) {
  return LengthCheck(known, model).doubts();
}

}  // namespace tanglebin
