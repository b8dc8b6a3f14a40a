#pragma once

#include <filesystem>
#include <iosfwd>
#include <map>
#include <string>

#include "tanglebin/model/model_tubes.hpp"

namespace tanglebin {

/// The latest format of profiles that read_profile() reads, and the one that write_profile() writes.
inline constexpr int profile_format = 1;

/// Reads a profile (TOML, docs/formats.md): sets the parameters that it names, and leaves the others. Throws
/// InputError with file, line and key for what is not a parameter or has an invalid value.
void read_profile(std::istream& in, const std::string& name, ModelSettings& settings);
void read_profile(const std::filesystem::path& file, ModelSettings& settings);

/// Writes parameters (parameters.hpp) as a profile. `made_from` is a comment: what they were learned from.
void write_profile(std::ostream& out, const std::map<std::string, double>& parameters,
                   const std::string& made_from);

}  // namespace tanglebin
