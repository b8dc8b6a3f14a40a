#pragma once

#include <cstddef>
#include <string>

namespace tanglebin {

/// What became of the points of a cloud. Every point counts once: as the first of these that applies to it.
struct PointCounts {
  std::size_t all = 0;
  std::size_t invalid = 0;        ///< without a finite position
  std::size_t behind_camera = 0;  ///< the camera cannot have seen them
  std::size_t outside_image = 0;  ///< nor these
  std::size_t below_support = 0;  ///< under the bin's floor or the plane, or on what the bin stands on
  std::size_t cropped = 0;        ///< farther from the support than tubes can be
  std::size_t on_support = 0;     ///< labelled as the bin
  std::size_t on_tubes = 0;       ///< labelled as a tube
  std::size_t near_support = 0;   ///< within half a radius of the support: noise, or not quite its shape
  std::size_t unexplained = 0;    ///< looked at, but on no tube
};

/// Something that does not fit, or a reason why there is no result.
struct Finding {
  enum class Severity {
    warning,  ///< the result may be worse for it
    error,    ///< the result is not to be used: the scan does not fit the scene, or shows no tube
  };
  Severity severity;
  std::string code;     ///< what it is, for programs: "frame", "radius", … (docs/formats.md)
  std::string message;  ///< what was seen and what to try: a sentence without a full stop
};

}  // namespace tanglebin
