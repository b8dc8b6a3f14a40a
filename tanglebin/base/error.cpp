#include "tanglebin/base/error.hpp"

#include "tanglebin/base/text.hpp"

namespace tanglebin {
namespace {

std::string message(const InputPlace& place, const std::string& problem) {
  std::string text = place.file;
  if (place.line > 0) text += ":" + std::to_string(place.line);
  if (!text.empty()) text += ": ";
  if (!place.field.empty()) text += place.field + ": ";
  return printable(text + problem);
}

}  // namespace

InputError::InputError(const InputPlace& place, const std::string& problem)
    : std::runtime_error(message(place, problem)), place_(place), problem_(problem) {}

InputError::InputError(const InputPlace& place, const std::string& found, const std::string& expected)
    : InputError(place, "found " + found + ", expected " + expected) {}

SystemError::SystemError(const std::string& file, const std::string& problem)
    : SystemError(message({.file = file}, problem)) {}

}  // namespace tanglebin
