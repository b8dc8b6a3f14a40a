#pragma once

#include <map>
#include <string>

namespace tanglebin {

/// Name and version of what a dataset's bytes can depend on beside its recipe (docs/determinism.md):
/// Tanglebin, the compiler, the libraries, the C library and the machine.
using Versions = std::map<std::string, std::string>;

/// Those of this program on this machine.
Versions versions();

}  // namespace tanglebin
