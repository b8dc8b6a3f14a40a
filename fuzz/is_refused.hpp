#pragma once

#include <cstdlib>
#include <string>

#include "tanglebin/base/error.hpp"

/// Calls `call` and returns true if it threw an InputError, whose message must fit on one line.
template <typename Call>
bool is_refused(Call call) {
  try {
    call();
  } catch (const tanglebin::InputError& error) {
    if (std::string(error.what()).find('\n') != std::string::npos) std::abort();
    return true;
  }
  return false;
}
