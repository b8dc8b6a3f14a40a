#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "fuzz/is_refused.hpp"

/// Calls `read_and_write` with an input, of which it either writes what it has read or throws InputError.
/// What it writes it must read and write again as the same.
template <typename ReadAndWrite>
void expect_same_again(const std::uint8_t* data, std::size_t size, const ReadAndWrite& read_and_write) {
  std::string written;
  if (is_refused([&] { written = read_and_write(std::string(data, data + size)); })) return;
  // An exception from here on is a bug: the project cannot read what it writes.
  if (read_and_write(written) != written) std::abort();
}
