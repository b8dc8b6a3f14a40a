#pragma once

#include <map>
#include <string>

namespace tanglebin {

/// Name and version of everything but the recipe that a dataset's bytes can depend on (docs/determinism.md):
/// Tanglebin, the compiler, the libraries, the C library and the machine.
using Versions = std::map<std::string, std::string>;

/// The versions of this program on this machine.
Versions versions();

/// SHA-256 of the program that runs, or of the shared library with this code.
const std::string& program_sha256();

}  // namespace tanglebin
