#include "tanglebin/base/stride.hpp"

namespace tanglebin {
namespace {

bool has_divisor(std::size_t number) {
  for (std::size_t i = 2; i * i <= number; ++i) {
    if (number % i == 0) return true;
  }
  return false;
}

}  // namespace

std::size_t sampling_stride(std::size_t items, std::size_t wanted) {
  std::size_t stride = items / wanted + 1;
  while (has_divisor(stride)) ++stride;
  return stride;
}

}  // namespace tanglebin
