// Any input is JSON that can be written, no JSON, or nested too deep.

#include <cstddef>
#include <cstdint>
#include <string>

#include "tanglebin/files/json_record.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const tanglebin::Json json = tanglebin::parse_json(std::string(data, data + size), {"fuzz", 1, ""});
    if (!json.is_discarded()) json.dump();
  } catch (const tanglebin::InputError&) {
    return 0;
  }
  return 0;
}
