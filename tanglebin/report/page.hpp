#pragma once

#include <string>

#include "tanglebin/report/results.hpp"

namespace tanglebin {

/// The report: a self-contained HTML page, without network access or scripts. Its bytes depend only on the
/// results. Throws std::runtime_error if gnuplot, which draws the plots, is not installed or fails.
std::string report_page(const Results& results);

}  // namespace tanglebin
