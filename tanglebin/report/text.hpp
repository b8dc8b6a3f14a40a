#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "tanglebin/report/selection.hpp"

// How the report words things. Text, to be escaped, but where `html` is said.
namespace tanglebin {

/// "28.10"; "–" for none. The paper has two decimals.
std::string seconds_text(std::optional<double> seconds, int decimals = 2);

/// "0.913"; "–" for none.
std::string share_text(std::optional<double> share);

/// A ratio, with no more digits than it needs: "0.3".
std::string ratio_text(double ratio);

/// "1 tube", "10 tubes".
std::string counted(std::size_t count, std::string_view noun);

/// "Set A", with its method where the results have several.
std::string group_text(const RunGroup& group, const Results& results);

/// A section of the page, as HTML.
std::string section_html(std::string_view id, std::string_view heading, const std::string& content_html);

}  // namespace tanglebin
