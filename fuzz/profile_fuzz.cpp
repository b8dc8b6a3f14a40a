// Any input is either a profile, which must read back as the same after writing, or an InputError.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string>

#include "fuzz/is_refused.hpp"
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
  std::string written;
  if (is_refused([&] { written = read_and_write(std::string(data, data + size)); })) return 0;
  // An exception from here on is a bug: the project cannot read what it writes.
  if (read_and_write(written) != written) std::abort();
  return 0;
}
