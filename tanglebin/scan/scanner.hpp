#pragma once

#include <memory>
#include <vector>

#include "tanglebin/scan/scan.hpp"
#include "tanglebin/settle/bin.hpp"
#include "tanglebin/tube/tube.hpp"

namespace tanglebin {

/// The ideal scanner of the paper: one ray through each pixel's centre, no noise.
/// Only the pixels that can see the bin or a tube are traced.
Scan scan(const std::vector<Tube>& tubes, const Bin& bin, const Camera& camera);

}  // namespace tanglebin
