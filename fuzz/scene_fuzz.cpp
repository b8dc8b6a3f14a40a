// Any input is either a scene file, which must read back as the same after writing, or an InputError. No
// camera file is there.

#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>

#include "fuzz/expect_same_again.hpp"
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
  expect_same_again(data, size, read_and_write);
  return 0;
}
