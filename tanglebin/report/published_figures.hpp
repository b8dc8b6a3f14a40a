#pragma once

#include <optional>
#include <string_view>

// The numbers printed in the paper's Section 6: G. Leão, C. M. Costa, A. Sousa, L. P. Reis, G. Veiga: Using
// Simulation to Evaluate a Tube Perception Algorithm for Bin Picking. Robotics 11(2), 46, 2022,
// doi:10.3390/robotics11020046. Functions return none for numbers that it does not print.
namespace tanglebin {

/// The machine on which the paper's times were measured (Section 6).
inline constexpr std::string_view published_machine =
    "Intel Core i7-8750H (2.20 GHz), 32 GB DDR4 RAM (2667 MHz), NVidia GeForce GTX 1050 Ti";

/// Downsampling ratio of Figure 8 and number of tubes of Figure 9.
inline constexpr double figure_8_ratio = 0.3;
inline constexpr int figure_9_tubes = 10;

/// Table 1: s, mean time to generate a case of set "A" or "B".
std::optional<double> published_generation_time(std::string_view set, int tubes);

/// Table 2: s, mean time to model the tubes of a case of set "A".
std::optional<double> published_modelling_time(std::string_view set, int tubes, double ratio);

/// Section 6.2: approximate mean micro-recall of set "B" at figure_8_ratio, for 1, 2 and 10 tubes. (Figure 8
/// has no numbers at its points.)
std::optional<double> published_micro_recall(std::string_view set, int tubes);

}  // namespace tanglebin
