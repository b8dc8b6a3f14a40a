#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tanglebin {

/// Which of the `known` names, of which there is at least one, an unknown one may stand for: "did you mean
/// 'x'?" with one that differs in few characters or begins with it, else "expected one of x, y", or what else
/// is expected if they are too many.
std::string suggestion(std::string_view name, const std::vector<std::string_view>& known,
                       std::string_view expected = {});

/// Throws InputError, which says that an unknown name was found, and then the suggestion.
[[noreturn]] void reject_name(std::string_view name, const std::vector<std::string_view>& known,
                              std::string_view expected = {});

}  // namespace tanglebin
