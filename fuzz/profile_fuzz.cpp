// Any input is either a profile, which must read back as the same after writing, or an InputError.

#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>

#include "fuzz/expect_same_again.hpp"
#include "tanglebin/profile/profile.hpp"

namespace {

std::string read_and_write(const std::string& text) {
  std::istringstream in(text);
  std::ostringstream out;
  tanglebin::write_profile(out, tanglebin::read_profile(in, "fuzz"), "fuzz");
  return out.str();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  expect_same_again(data, size, read_and_write);
  return 0;
}
