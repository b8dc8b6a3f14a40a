#pragma once

#include <string>
#include <vector>

/// An independent judge of configuration files: it includes nothing of Tanglebin, reads the text by itself
/// and measures distances in its own way, so that a mistake there cannot excuse itself here. Metres.
namespace checker {

/// Floor at z = 0, walls up to the rim, centred on the origin.
struct CheckerBin {
  double length;       ///< inner, along x
  double width;        ///< inner, along y
  double wall = 0.02;  ///< thickness
  double rim = 0.20;   ///< height
};

/// What every tube must be: a chain of cylinders.
struct CheckerTube {
  double bend_min_deg;  ///< between consecutive cylinders
  double bend_max_deg;
  double length = 0.5;
  double cylinder_min = 0.02;
  double radius = 0.0125;
};

/// All that is wrong with the tubes of a configuration file, a sentence each; empty for a good file. Wrong
/// are: text that is not such a file; another number of tubes; a tube of another radius, length (by more than
/// 1 µm), shorter cylinders or other bends; cylinders that are no chain from node 1 to node 2, or contradict
/// their nodes; a tube whose centre is not between the walls; and more than 0.3 mm of overlap of two tubes,
/// or of one with floor or wall.
std::vector<std::string> faults_of(const std::string& configuration_file, const CheckerBin& bin,
                                   const CheckerTube& tube, int tubes);

}  // namespace checker
