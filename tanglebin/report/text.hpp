#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "tanglebin/report/selection.hpp"
#include "tanglebin/report/summary.hpp"

// Formats values for the report. Returns text that still has to be escaped, unless the name says `html`.
namespace tanglebin {

/// "28.10"; "–" for none. Two decimals, as in the paper.
std::string seconds_text(std::optional<double> seconds, int decimals = 2);

/// "0.913"; "–" for none.
std::string share_text(std::optional<double> share);

/// "0.931 ± 0.012": a mean and half its confidence interval, if it has one.
std::string mean_text(const Summary& summary);

/// A ratio with as few digits as possible: "0.3".
std::string ratio_text(double ratio);

/// "1 tube", "10 tubes".
std::string counted(std::size_t count, std::string_view noun);

/// "Set A", with the method if the results have several.
std::string group_text(const RunGroup& group, const Results& results);

/// A section of the page, as HTML.
std::string section_html(std::string_view id, std::string_view heading, const std::string& content_html);

}  // namespace tanglebin
