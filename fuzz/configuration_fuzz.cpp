// Any input is either a configuration, which must survive writing and reading, or an InputError.

#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>

#include "fuzz/expect_same_again.hpp"
#include "tanglebin/io/configuration.hpp"

namespace {

std::string read_and_write(const std::string& text) {
  std::istringstream in(text);
  std::ostringstream out;
  tanglebin::write_configuration(out, tanglebin::read_configuration(in, "fuzz"));
  return out.str();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  expect_same_again(data, size, read_and_write);
  return 0;
}
