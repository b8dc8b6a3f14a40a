#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "tanglebin/geometry/tube.hpp"

namespace tanglebin {

/// Reads tubes in the published text format (docs/formats.md). Strict about structure: counts, ids, names, a
/// tree of known nodes, a single positive radius per tube, finite numbers, nothing after the last tube. Edges
/// may differ from their nodes by at most 0.1 mm. Otherwise accepts what real files contain, such as tubes
/// that overlap or float. Tubes with flat ends are marked as such. Throws InputError with file, line and
/// field.
std::vector<Tube> read_configuration(std::istream& in, const std::string& name);
std::vector<Tube> read_configuration(const std::filesystem::path& file);

/// Writes that format, with "flat" behind the counts of a tube with flat ends, and each number with the
/// fewest digits that read back as the same double. Throws InputError as validate(Tube) does, and unless the
/// tubes have distinct ids of at least 1.
void write_configuration(std::ostream& out, const std::vector<Tube>& tubes);

}  // namespace tanglebin
