#pragma once

#include <string>

#include "tanglebin/base/error.hpp"

namespace tanglebin {

/// Throws an InputError about a field unless what is expected of it holds.
inline void expect(bool holds, const std::string& field, const std::string& found,
                   const std::string& expected) {
  if (!holds) throw InputError({.file = "", .line = 0, .field = field}, found, expected);
}

}  // namespace tanglebin
