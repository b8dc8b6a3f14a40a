#pragma once

#include "tanglebin/scan/scan.hpp"

namespace tanglebin {

// Internal to the room: what is done to an image of measured depths.

/// Fills gaps of at most `longest` lost pixels between two measured ones of a row, such as narrow shadows,
/// with depths that go straight from one to the other, each on its own pixel's ray. A filled pixel takes the
/// nearer one's label, normal, incidence and signal, and is marked as mixed.
void fill_gaps(Scan& scan, int longest);

/// Rounds depths to whole steps (m). A depth that rounds to 0 is lost.
void quantize(Scan& scan, double step);

/// Gives each pixel the median depth of the square window around it, `size` pixels wide, on its own ray. A
/// pixel without a measurement counts as farther than all others, so if most of the window is lost, the pixel
/// is lost. A lost pixel, and one whose ray met another surface than the measurement with the median depth,
/// gets that one's label, normal, incidence and signal too, and is marked as mixed. Any other keeps these. It
/// is marked as mixed if its new depth is that of a mixed pixel.
Scan median_filtered(const Scan& scan, int size);

}  // namespace tanglebin
