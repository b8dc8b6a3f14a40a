// Any input is either a scene file, which must read back as the same after writing, or an InputError. No
// camera file is there.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string>

#include "fuzz/is_refused.hpp"
#include "tanglebin/scene/read_scene.hpp"
#include "tanglebin/scene/write_scene.hpp"

namespace {

std::string read_and_write(const std::string& text) {
  std::istringstream in(text);
  std::ostringstream out;
  tanglebin::write_scene(out, tanglebin::read_scene(in, "fuzz", "/nowhere"));
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
