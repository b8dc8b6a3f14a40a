#pragma once

#include <sstream>
#include <string>
#include <utility>

namespace tanglebin {

/// What `write` writes to a stream.
template <typename Write>
std::string bytes_of(const Write& write) {
  std::ostringstream out;
  write(out);
  return std::move(out).str();
}

}  // namespace tanglebin
