#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tanglebin {

/// The one of the `known` names, of which there is at least one, that an unknown one may stand for: one that
/// differs in few characters or begins with it, if there is any.
std::optional<std::string_view> nearest_name(std::string_view name,
                                             const std::vector<std::string_view>& known);

/// Which of the `known` names, of which there is at least one, an unknown one may stand for: "did you mean
/// 'x'?" with one that differs in few characters or begins with it, else "expected one of x, y".
std::string suggestion(std::string_view name, const std::vector<std::string_view>& known);

}  // namespace tanglebin
