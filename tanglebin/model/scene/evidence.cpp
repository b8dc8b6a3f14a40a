#include "tanglebin/model/scene/evidence.hpp"

namespace tanglebin {

std::string name_of(LengthFit fit) {
  switch (fit) {
    case LengthFit::unknown:
      return "unknown";
    case LengthFit::complete:
      return "complete";
    case LengthFit::too_short:
      return "too_short";
    case LengthFit::too_long:
      break;
  }
  return "too_long";
}

}  // namespace tanglebin
