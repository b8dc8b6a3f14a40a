#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tanglebin {

/// Which of the `known` names, of which there is at least one, an unknown one may stand for: "did you mean
/// 'x'?" with one that differs in few characters or begins with it, else "expected one of x, y".
std::string suggestion(std::string_view name, const std::vector<std::string_view>& known);

}  // namespace tanglebin
