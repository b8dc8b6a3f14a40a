#include "tanglebin/cloud/depth_scales.hpp"

namespace tanglebin {

std::vector<double> other_depth_scales(double told) {
  std::vector<double> scales;
  for (const double digit : {1.0, 2.0, 5.0}) {
    for (const double power : {10.0, 100.0, 1000.0}) {
      scales.push_back(told * power / (digit == 1 ? 1 : 10) * digit);
      scales.push_back(told / power * digit);
    }
  }
  return scales;
}

}  // namespace tanglebin
