#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/model/segment_tree.hpp"
#include "tanglebin/scan/camera.hpp"
#include "tanglebin/settle/bin.hpp"
#include "tanglebin/tube/tube.hpp"

namespace tanglebin {

/// What is known of each tube of a kind.
struct TubeKind {
  double radius = 0.0125;                ///< m
  SegmentTree segments = {{1, 2, 0.5}};  ///< one for a chain, several for a tree

  /// m, along its centre line, branches included.
  double length() const { return total_length(segments); }
  /// Whether it is a tree.
  bool branches() const { return segments.size() > 1; }
};

/// What is known of a scene before its cloud is looked at.
struct KnownScene {
  Bin bin;
  Camera camera;                                           ///< that took the cloud
  std::vector<TubeKind> kinds = std::vector<TubeKind>(1);  ///< of tubes, told apart by their radii
};

/// Throws InputError naming the field of a scene that is none: what bin and camera refuse, no kind, a radius
/// that is not a finite positive number, segments that are no tree, a radius of two kinds or too small for
/// the bin.
void validate(const KnownScene& known);

/// What a step of a method left, and how long it took.
struct Step {
  std::string name;   ///< "filter", "segment", …
  double seconds;     ///< wall clock
  std::size_t count;  ///< how many things it left
  std::string of;     ///< what these are: "points", "clusters", …
};

/// Tubes found in a cloud.
struct Model {
  std::vector<Tube> tubes;            ///< ids 1, 2, …, of mass 0 (not known)
  std::vector<std::int32_t> labels;   ///< a tube's id, bin_label or null_label for each point of the cloud
  std::vector<std::size_t> filtered;  ///< the points that the method's filter left, ascending; Section 5
                                      ///< scores their labels
  std::vector<Step> steps;            ///< in their order
};

/// The ways to model tubes.
enum class Method {
  paper,  ///< the paper's, Section 4; for chains
  axis,   ///< by votes for the tubes' axes; for chains and trees
};

/// Every method, in the order in which tables show them.
std::vector<Method> methods();

/// "paper" or "axis". The inverse throws InputError for another name.
std::string name_of(Method method);
Method method_named(const std::string& name);

/// Models the tubes of a cloud (m; a subset of what the known camera saw, in any order; labels and colours
/// are not looked at) from a random share `ratio` (0 < ratio ≤ 1, drawn from `seed`) of its points. Every
/// point gets a label, those left out of the modelling too. The result follows from the arguments alone.
/// Throws InputError for a scene or ratio that is none, for several kinds of tubes where the method knows one
/// only (paper) and, with `name`, for a cloud that cannot be of this scene: one in millimetres, say.
Model model_tubes(const PointCloud& cloud, const KnownScene& known, Method method, double ratio,
                  std::uint64_t seed, const std::string& name);

}  // namespace tanglebin
