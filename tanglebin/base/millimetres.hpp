#pragma once

#include <string>

namespace tanglebin {

/// For a message about a length of more than `most`, m: "; for 8 mm write 0.008" if it may be meant in
/// millimetres, which is from 1 on and if it is at most `most` in these; else nothing.
std::string hint_of_millimetres(double metres, double most);

}  // namespace tanglebin
