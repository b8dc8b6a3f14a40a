#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "tanglebin/geometry/tube.hpp"

namespace tanglebin {

/// Reads tubes in the published text format (docs/formats.md). Strict about structure (counts, ids, names, a
/// tree of known nodes, one positive radius a tube, finite numbers, nothing after the last tube) and about
/// edges that contradict their nodes by more than 0.1 mm; takes what real files have beyond that (tubes that
/// overlap or float). Throws InputError with file, line and field.
std::vector<Tube> read_configuration(std::istream& in, const std::string& name);
std::vector<Tube> read_configuration(const std::filesystem::path& file);

/// Writes that format, each number in the fewest digits that read back as the same double.
void write_configuration(std::ostream& out, const std::vector<Tube>& tubes);

}  // namespace tanglebin
