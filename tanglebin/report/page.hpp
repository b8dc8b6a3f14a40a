#pragma once

#include <string>

#include "tanglebin/report/results.hpp"

namespace tanglebin {

/// The report: an HTML page that needs no other file, no network and no scripts. Follows from the results
/// alone, byte for byte. Throws std::runtime_error where gnuplot, which draws the plots, is not installed or
/// fails.
std::string report_page(const Results& results);

}  // namespace tanglebin
