// Any input is a picture of the expected size or an error with a message on one line.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "tanglebin/dataset/verify_case.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr int width = 12;  // size of the seeds
  constexpr int height = 8;
  const std::string fault = tanglebin::fault_of_png(std::string(data, data + size), width, height);
  if (fault.find_first_of("\n\t") != std::string::npos) std::abort();
  return 0;
}
