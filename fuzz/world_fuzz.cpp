// Any input is an SDF world or an error with a message on one line.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "tanglebin/dataset/verify_case.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string fault = tanglebin::fault_of_world(std::string(data, data + size));
  if (fault.find_first_of("\n\t") != std::string::npos) std::abort();
  return 0;
}
