#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "tanglebin/scan/occlusion.hpp"
#include "tanglebin/scan/scan.hpp"

namespace tanglebin {

/// Some pixels of an image.
struct Mask {
  int width;   ///< of the image
  int height;  ///< of the image
  /// row * width + column, ascending
  std::vector<std::uint32_t> pixels;
};

/// The mask of each tube 1, 2, …, n as the scanner measured it: the pixels that have its label.
std::vector<Mask> measured_masks(const Scan& scan, std::size_t tubes);

/// The mask of a tube as a whole.
Mask whole_mask(const WholeView& view, const Camera& camera);

/// Column and row of the upper left pixel, width and height of the smallest box around a mask; nothing but
/// zeros if the mask is empty.
std::array<int, 4> box_of(const Mask& mask);

/// COCO's run lengths of a mask: of the pixels column by column, how many are outside, inside, outside, …
std::vector<std::uint32_t> run_lengths(const Mask& mask);

/// COCO's compressed form of run lengths, as pycocotools reads and writes it: from the fourth on, each is the
/// difference from the last but one; numbers have five bits per character, lowest first, two's complement, a
/// sixth bit where more characters follow, and 48 is added.
std::string compressed(const std::vector<std::uint32_t>& run_lengths);

/// The corners of a closed polygon: x, y, x, y, …, pixels; (0, 0) is the image's upper left corner, so the
/// first pixel's centre is at (0.5, 0.5).
using Polygon = std::vector<int>;

/// A mask's outlines along the edges of its pixels: a polygon for each part (a pixel has four neighbours).
/// Filled by the even-odd or the nonzero rule, together they are the mask. A part with holes is still one
/// polygon: it goes to each hole and back on the same way.
std::vector<Polygon> polygons(const Mask& mask);

}  // namespace tanglebin
