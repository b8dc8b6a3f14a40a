#pragma once

#include <string>

// Internal to the library: TOML before it is parsed.
namespace tanglebin {

/// TOML with the same meaning in ASCII: strings have escapes, comments '?' for other characters, at which
/// toml++ 3.3 may run into __builtin_unreachable. Throws InputError with file and line if there are such
/// characters outside of strings and comments, or more than 64 levels of brackets and dots: toml++ and what
/// reads its trees call themselves once per level.
std::string checked_toml(const std::string& text, const std::string& name);

}  // namespace tanglebin
