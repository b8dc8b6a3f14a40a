#pragma once

#include <vector>

namespace tanglebin {

/// The scales that a depth image may have if the one that is told, in steps per metre, is wrong: the told one
/// times 1, 2 or 5 and a power of ten, from a thousandth to a thousand times. Powers of ten come first.
std::vector<double> other_depth_scales(double told);

}  // namespace tanglebin
