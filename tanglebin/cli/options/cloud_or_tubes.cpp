#include "tanglebin/cli/options/cloud_or_tubes.hpp"

#include <cctype>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <system_error>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/text.hpp"
#include "tanglebin/cli/options/arguments.hpp"
#include "tanglebin/io/read_cloud.hpp"
#include "tanglebin/io/read_tubes.hpp"

namespace tanglebin::cli {
namespace {

/// Looks at the first character only, which also works for pipes.
CloudOrTubes read(std::istream& in, const std::string& name) {
  const int first = in.peek();
  if (first == 'p' || first == '#' || first == 'V') return read_cloud(in, name);
  if (first == std::istream::traits_type::eof() || (std::isdigit(first) == 0 && first != '{')) {
    const bool is_empty = first == std::istream::traits_type::eof();
    const char character = std::istream::traits_type::to_char_type(first);
    throw InputError(
        {.file = name, .line = 0, .field = ""},
        is_empty ? "an empty file" : excerpt({&character, 1}) + " at the start",
        "a configuration, which begins with the number of tubes, tubes.json, or a PLY or PCD cloud");
  }
  return read_tubes(in, name);
}

}  // namespace

CloudOrTubes read_cloud_or_tubes(const std::string& file) {
  if (file == standard_stream) return read(std::cin, "standard input");
  // Linux lets you open a directory for reading.
  if (std::filesystem::is_directory(file)) {
    throw InputError({.file = file, .line = 0, .field = ""}, "a directory", "a configuration or a cloud");
  }
  std::ifstream in(file, std::ios::binary);
  if (!in) {
    throw InputError({.file = file, .line = 0, .field = ""},
                     "cannot be opened: " + std::generic_category().message(errno));
  }
  return read(in, file);
}

}  // namespace tanglebin::cli
