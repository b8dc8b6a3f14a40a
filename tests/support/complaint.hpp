#pragma once

#include <string>

#include "tanglebin/base/error.hpp"

namespace tanglebin::test {

/// What an action says of bad input or of a refusal: the text of the InputError or SystemError that it
/// throws; "none" where it throws none.
template <class Action>
std::string complaint(const Action& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  } catch (const SystemError& error) {
    return error.what();
  }
  return "none";
}

}  // namespace tanglebin::test
