#pragma once

#include <string>

namespace tanglebin {

/// For a message about a length that is too large, m: "; for 8 mm write 0.008" if it may be meant in
/// millimetres, which is from 1 on, else nothing.
std::string hint_of_millimetres(double metres);

}  // namespace tanglebin
