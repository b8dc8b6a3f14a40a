#include "tanglebin/cli/options/cloud_or_tubes.hpp"

#include <cctype>
#include <fstream>
#include <iostream>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/text.hpp"
#include "tanglebin/cli/options/arguments.hpp"
#include "tanglebin/files/read_file.hpp"
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
  std::ifstream in = open_input(file);
  return read(in, file);
}

}  // namespace tanglebin::cli
