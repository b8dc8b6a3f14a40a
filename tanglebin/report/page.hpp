#pragma once

#include <string>

#include "tanglebin/report/results.hpp"

namespace tanglebin {

/// The report: a self-contained HTML page, without network access. Without scripts, its tables, plots and
/// pictures remain. Its bytes depend only on the results and on `page`, the name of its file, which it tells.
std::string report_page(const Results& results, const std::string& page = "report.html");

}  // namespace tanglebin
