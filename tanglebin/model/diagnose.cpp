#include "tanglebin/model/diagnose.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <string>
#include <utility>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/median.hpp"
#include "tanglebin/base/stride.hpp"
#include "tanglebin/model/axis/radius.hpp"
#include "tanglebin/model/length_check.hpp"
#include "tanglebin/model/remedy.hpp"
#include "tanglebin/model/scene/support_frame.hpp"
#include "tanglebin/model/view_check.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3d;

double share_of(std::size_t part, std::size_t all) {
  return all == 0 ? 0 : static_cast<double>(part) / static_cast<double>(all);
}

// "7 %", "0.3 %"; never 0 % or 100 % of a part.
std::string percent(std::size_t part, std::size_t all) {
  constexpr double most = 99.9;
  const double value = 100 * share_of(part, all);
  return part == all  ? "all"
         : value < 1  ? fmt::format("{:.2g} %", value)
         : value > 99 ? fmt::format("{:.1f} %", std::min(value, most))
                      : fmt::format("{:.0f} %", value);
}

// To one decimal, so that what is above a limit does not look like the limit.
double rounded_up(double value) {
  return std::ceil(10 * value) / 10;
}

std::string millimetres(double metres) {
  return fmt::format("{:.3g} mm", 1000 * metres);
}

std::string metres(double value) {
  return fmt::format("{:.3g} m", value);
}

/// Collects what does not fit.
class Diagnosis {
public:
  Diagnosis(const PointCloud& cloud, const KnownScene& known, const Model& model, double ratio)
      : cloud_(cloud), known_(known), model_(model), counts_(model.counts), ratio_(ratio) {}

  std::vector<Finding> findings() {
    if (!has_points()) return findings_;
    look_for_points_in_scene();
    const bool do_points_fit = findings_.empty();
    if (do_points_fit) look_for_tubes();
    if (!model_.tubes.empty()) {
      doubt_radius();
      doubt_foreign();
      std::ranges::move(doubts_of_lengths(known_, model_), std::back_inserter(findings_));
      doubt_sensor();
    }
    doubt_fits();
    doubt_tubes();
    doubt_pieces();
    doubt_unexplained();
    doubt_view();
    std::ranges::move(doubts_of_camera(cloud_, known_, model_), std::back_inserter(findings_));
    if (do_points_fit)
      std::ranges::move(doubts_of_support(cloud_, known_, model_), std::back_inserter(findings_));
    return findings_;
  }

private:
  void add(Finding::Severity severity, std::string code, std::string message) {
    findings_.push_back({severity, std::move(code), std::move(message)});
  }
  void refuse(std::string code, std::string message) {
    add(Finding::Severity::error, std::move(code), std::move(message));
  }
  void warn(std::string code, std::string message) {
    add(Finding::Severity::warning, std::move(code), std::move(message));
  }

  bool has_support() const { return known_.support.shape != Support::Shape::nothing; }

  std::size_t valid() const { return counts_.all - counts_.invalid; }
  std::size_t unseen() const { return counts_.behind_camera + counts_.outside_image; }
  // Not on the support, nor near it.
  std::size_t kept() const { return counts_.on_tubes + counts_.unexplained; }

  bool has_points() {
    if (counts_.all == 0) refuse("empty", "the cloud has no points");
    if (counts_.all > 0 && valid() == 0)
      refuse("invalid", fmt::format("none of the cloud's {} points has a position: all are NaN or infinite",
                                    counts_.all));
    return valid() > 0;
  }

  // Points with a position, evenly chosen.
  std::vector<Vector3d> some_points(std::size_t wanted) const {
    const std::size_t stride = sampling_stride(valid(), wanted);
    std::vector<Vector3d> points;
    std::size_t number = 0;
    for (const Eigen::Vector3f& point : cloud_.points) {
      if (point.allFinite() && number++ % stride == 0) points.emplace_back(point.cast<double>());
    }
    return points;
  }

  std::size_t missed() const { return unseen() + counts_.below_support + counts_.cropped; }
  bool are_most_missed() const { return 2 * missed() > valid(); }
  bool are_some_unseen() const {
    constexpr std::size_t share = 50;
    return share * unseen() > valid();
  }
  bool is_most_unexplained() const { return 2 * counts_.unexplained > kept(); }
  // Or too far from the support, such as beside a bin that is told turned by 90°.
  bool is_most_not_on_tubes() const { return counts_.unexplained + counts_.cropped > counts_.on_tubes; }

  void look_for_points_in_scene() {
    if (!are_most_missed() && !are_some_unseen() && !is_most_not_on_tubes() && !model_.tubes.empty()) return;
    if (is_lower_floor_seen()) {
      warn("support",
           fmt::format(
               "{}, but the tubes above it look right: is that the floor of the room? Crop the cloud to "
               "the {} and what is around it",
               words_of_miss(), known_.support.shape == Support::Shape::plane ? "table" : "bin"));
      return;
    }
    constexpr std::size_t points_for_remedy = 150;
    const std::optional<Remedy> remedy =
        remedy_for(some_points(points_for_remedy), known_, cloud_.depth_scale);
    if (remedy) {
      refuse(remedy->code, fmt::format("{}; they {}", words_of_miss(), remedy->advice));
      return;
    }
    constexpr std::size_t least = 20;  // one in so many points must be in the scene
    if (2 * unseen() > valid()) {
      refuse("camera", words_of_miss() + "; are the camera's intrinsics and its pose those of this cloud?");
    } else if (least * (valid() - missed()) < valid()) {
      refuse("support", words_of_miss() +
                            "; is the support's pose right, and are the points in the frame and the "
                            "unit that the scene says?");
    }
  }

  // Most points are under the support, but what is above it is mostly on tubes that are probably right.
  bool is_lower_floor_seen() const {
    std::size_t right = 0;
    for (const TubeEvidence& evidence : model_.evidence) right += is_probable(evidence) ? evidence.points : 0;
    return are_most_missed() && !are_some_unseen() && largest_miss() == counts_.below_support &&
           2 * right > kept();
  }

  std::size_t largest_miss() const {
    return std::max({counts_.behind_camera, counts_.outside_image, counts_.below_support, counts_.cropped});
  }

  std::string words_of_miss() const {
    if (!are_most_missed()) return "the points do not fit the scene as they are";
    const std::size_t most = largest_miss();
    return fmt::format(
        "{} of the points {}", percent(most, valid()),
        most == counts_.behind_camera   ? "are behind the camera"
        : most == counts_.outside_image ? "are outside of the camera's image"
        : most == counts_.below_support
            ? fmt::format("are under the {}, {} deep in the median", floor(), metres(median_depth()))
        : !has_support() ? "are more than 20 m from the camera"
                         : fmt::format("are far from the {}", name_of(known_.support.shape)));
  }

  std::string floor() const {
    return known_.support.shape == Support::Shape::plane ? "plane" : "bin's floor";
  }

  // m, under the floor, of the points there.
  double median_depth() const {
    const Eigen::Isometry3d to_support = known_.support.pose.inverse(Eigen::Isometry);
    std::vector<double> depths;
    constexpr std::size_t wanted = 1000;
    for (const Vector3d& point : some_points(wanted)) {
      const double depth = -(to_support * point).z();
      if (depth > 0) depths.push_back(depth);
    }
    return depths.empty() ? 0 : median(std::move(depths));
  }

  std::string words_of_empty() const {
    const std::string most = fmt::format("{} of the points are on the {}",
                                         percent(counts_.on_support + counts_.near_support, valid()),
                                         name_of(known_.support.shape));
    if (kept() == 0) return "nothing is left to look for tubes in: " + most + ": it looks empty";
    return fmt::format(
        "{}, and none of the {} others is on a tube of radius {}: it looks empty, or is the radius wrong?",
        most, kept(), radii());
  }

  void look_for_tubes() {
    if (!model_.tubes.empty()) return;
    constexpr double nearly_none = 0.01;
    if (share_of(kept(), valid()) < nearly_none) {
      refuse("no-tubes", words_of_empty());
      return;
    }
    if (model_.filtered.empty()) {
      refuse("no-tubes",
             fmt::format("none of the {} points that may be on tubes was looked at, at a ratio of "
                         "{}: downsample less",
                         kept(), ratio_));
      return;
    }
    if (ratio_ < 1) {
      refuse("no-tubes",
             fmt::format("none of the {} points looked at, at a ratio of {}, is on a tube of radius "
                         "{}: downsample less",
                         model_.filtered.size(), ratio_, radii()));
      return;
    }
    const std::optional<double> radius = other_radius();
    refuse(radius ? "radius" : "no-tubes",
           fmt::format("none of the {} points looked at is on a tube of radius {}{}", model_.filtered.size(),
                       radii(),
                       radius ? fmt::format("; they look like tubes of radius {}: --radius {:.4f}",
                                            millimetres(*radius), *radius)
                              : ""));
  }

  // "12.5 mm", "8 or 12.5 mm"
  std::string radii() const {
    std::string text;
    for (const TubeKind& kind : known_.kinds)
      text += fmt::format("{}{:.3g}", text.empty() ? "" : " or ", 1000 * kind.radius);
    return text + " mm";
  }

  // The radius that the cloud suggests, if it is clearly not a known one.
  std::optional<double> other_radius() const {
    try {
      const Seen seen = in_support_frame(cloud_, known_);
      const double radius = estimate_radius(seen.cloud, seen.known).radius;
      constexpr double same = 0.15;
      const bool is_known = std::ranges::any_of(
          known_.kinds, [&](const TubeKind& kind) { return std::abs(radius / kind.radius - 1) < same; });
      return is_known ? std::nullopt : std::optional(radius);
    } catch (const InputError&) {
      return std::nullopt;
    }
  }

  static bool is_clear(const TubeEvidence& evidence) {
    constexpr std::size_t points_min = 100;
    return evidence.points >= points_min;
  }

  static constexpr double probable = 0.5;  // confidence

  static bool is_probable(const TubeEvidence& evidence) { return evidence.confidence >= probable; }

  // The median over the tubes that have enough points and are probably right; over all that have enough
  // points, if none is.
  template <typename Value>
  std::optional<double> median_of_tubes(Value value) const {
    std::vector<double> all;
    std::vector<double> right;
    for (std::size_t i = 0; i < model_.tubes.size(); ++i) {
      const TubeEvidence& evidence = model_.evidence[i];
      if (!is_clear(evidence)) continue;
      all.push_back(value(model_.tubes[i], evidence));
      if (is_probable(evidence)) right.push_back(all.back());
    }
    if (all.empty()) return std::nullopt;
    return median(right.empty() ? std::move(all) : std::move(right));
  }

  // Of the points about the tubes, in radii.
  std::optional<double> scatter() const {
    return median_of_tubes(
        [](const Tube& tube, const TubeEvidence& evidence) { return evidence.residual / tube.radius; });
  }

  void doubt_radius() {
    const std::optional<double> error = median_of_tubes(
        [](const Tube& tube, const TubeEvidence& evidence) { return evidence.radius_error / tube.radius; });
    constexpr double tolerance = 0.06;
    constexpr double scatters = 1.7;  // noise makes tubes look thicker by 1.5 times their scatter at most
    const bool look_thin = error && *error < -tolerance;
    const std::optional<double> other = is_most_unexplained() || look_thin ? other_radius() : std::nullopt;
    if (other && is_most_unexplained()) {
      warn("radius", fmt::format("most points are on no tube of radius {}; they look like tubes of radius {}",
                                 radii(), millimetres(*other)));
    } else if (other) {
      warn("radius", fmt::format("the tubes look like tubes of radius {}, not {}: is the radius right, and "
                                 "the cloud's scale?",
                                 millimetres(*other), radii()));
    } else if (error && std::abs(*error) > std::max(tolerance, scatters * *scatter())) {
      warn("radius",
           fmt::format("the tubes look {:.0f} % {} than their radius of {}: is it right? --radius auto "
                       "estimates it",
                       100 * std::abs(*error), *error > 0 ? "thicker" : "thinner", radii()));
    }
  }

  void doubt_foreign() {
    if (model_.foreign_radii.empty()) return;
    const auto [thinnest, thickest] = std::ranges::minmax(model_.foreign_radii);
    constexpr double same = 1.2;
    const std::string seen =
        thickest < same * thinnest
            ? fmt::format("a radius of about {:.2g} mm", 1000 * median(model_.foreign_radii))
            : fmt::format("radii of about {:.2g} to {:.2g} mm", 1000 * thinnest, 1000 * thickest);
    const bool is_one = model_.foreign_radii.size() == 1;
    warn("foreign",
         fmt::format("{} {} {}, not {}: left out. {} of a second kind of tube, to be declared as [[tube]]?",
                     model_.foreign_radii.size(), is_one ? "tube has" : "tubes have", seen, radii(),
                     is_one ? "Is it a foreign part, or" : "Are they foreign parts, or"));
  }

  void doubt_sensor() {
    const std::optional<double> across = median_of_tubes([](const Tube& tube, const TubeEvidence& evidence) {
      return std::sqrt(2 * tube.radius * static_cast<double>(evidence.points) /
                       std::max(evidence.visible_length, tube.radius));
    });
    constexpr double points_across_min = 5;
    if (across && *across * std::sqrt(ratio_) < points_across_min)
      warn("coarse",
           fmt::format(
               "only {:.1f} points lie across a tube, and fewer than {} are too few to tell tubes apart "
               "safely: scan from nearer, with more pixels, or downsample less",
               *across * std::sqrt(ratio_), points_across_min));
    const std::optional<double> noise = scatter();
    constexpr double noise_max = 0.1;
    if (noise && *noise > noise_max)
      warn("noise", fmt::format("the points scatter about the tubes by {:.1f} % of the radius, and more than "
                                "{:.0f} % is too much to "
                                "tell tubes apart safely: is the sensor that noisy, or the radius wrong?",
                                rounded_up(100 * *noise), 100 * noise_max));
  }

  // Half of a tube that is hidden between two others may be taken for a part of each.
  void doubt_fits() {
    constexpr double times = 5;
    constexpr double radii_min = 0.1;
    const std::optional<double> usual = scatter();
    std::string ids;
    double worst = 0;
    for (std::size_t i = 0; i < model_.tubes.size(); ++i) {
      const TubeEvidence& evidence = model_.evidence[i];
      const double scatter = evidence.residual / model_.tubes[i].radius;
      if (!usual || !is_clear(evidence) || scatter < std::max(times * *usual, radii_min)) continue;
      ids += fmt::format("{}{}", ids.empty() ? "" : ", ", model_.tubes[i].id);
      worst = std::max(worst, scatter);
    }
    if (ids.empty()) return;
    warn(
        "fit",
        fmt::format(
            "the points of tube {} scatter by up to {:.0f} % of the radius, those of the others by {:.2g} %: "
            "points of a neighbour may have been taken for its own",
            ids, 100 * worst, 100 * *usual));
  }

  void doubt_tubes() {
    const auto unlikely = std::ssize(model_.tubes) - std::ranges::count_if(model_.evidence, is_probable);
    if (unlikely == 0 || 2 * unlikely < std::ssize(model_.tubes)) return;
    warn("confidence",
         fmt::format(
             "{} of {} tubes are probably wrong: their confidence is below {}. Is the radius right, and "
             "is there anything but such tubes?{}",
             unlikely, model_.tubes.size(), probable,
             has_support() ? "" : " Give [support]: floor or walls may have been taken for tubes"));
  }

  void doubt_pieces() {
    if (model_.pieces_left_out == 0) return;
    warn("pieces",
         fmt::format(
             "{} pieces that may be tubes of radius {} were left out, the smallest: there are too many "
             "to compare, and most must be noise. {}",
             model_.pieces_left_out, radii(),
             has_support() ? "Is the radius right?"
                           : "Is the radius right? Give [support]: what is on it is not looked at"));
  }

  // Where no support is known, floor and walls are on no tube either.
  void doubt_unexplained() {
    constexpr std::size_t share = 5;
    if (!has_support() || model_.tubes.empty() || share * counts_.unexplained <= kept()) return;
    const char* others = ": are there other things, or tubes of another radius, to be declared as [[tube]]?";
    warn("unexplained",
         fmt::format("{} of the points looked at are on no tube{}", percent(counts_.unexplained, kept()),
                     model_.foreign_radii.empty() ? others : ""));
  }

  void doubt_view() {
    if (!are_some_unseen() || 2 * unseen() > valid()) return;
    warn("camera",
         fmt::format("{} of the points are {}, where it cannot have seen them: they are null",
                     percent(unseen(), valid()),
                     counts_.behind_camera > counts_.outside_image ? "behind the camera"
                                                                   : "outside of the camera's image"));
  }

  const PointCloud& cloud_;
  const KnownScene& known_;
  const Model& model_;
  const PointCounts& counts_;
  double ratio_;
  std::vector<Finding> findings_;
};

}  // namespace

std::vector<Finding> diagnose(const PointCloud& cloud, const KnownScene& known, const Model& model,
                              double ratio) {
  return Diagnosis(cloud, known, model, ratio).findings();
}

}  // namespace tanglebin
