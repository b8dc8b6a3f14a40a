#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tanglebin/base/random.hpp"
#include "tanglebin/settle/bin.hpp"
#include "tanglebin/tube/tube.hpp"

namespace tanglebin {

/// How tubes fall and come to rest. (filled in by the settle room)
struct SettleSettings {
  double step = 0.002;  ///< s, integration step
};

}  // namespace tanglebin
