#pragma once

#include <string>
#include <string_view>

namespace tanglebin {

/// Text from a file as an error message shows it: in quotes, on one line, cut after 40 characters.
std::string excerpt(std::string_view text);

}  // namespace tanglebin
