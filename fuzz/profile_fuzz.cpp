// Any input is either a profile, whose parameters must read back as the same after writing, or an InputError.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string>

#include "fuzz/is_refused.hpp"
#include "tanglebin/model/parameters.hpp"
#include "tanglebin/profile/profile.hpp"

namespace {

std::string read_and_write(const std::string& text) {
  std::istringstream in(text);
  tanglebin::ModelSettings settings;
  tanglebin::read_profile(in, "fuzz", settings);
  std::ostringstream out;
  tanglebin::write_profile(out, tanglebin::parameters(settings), "fuzz");
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
