#include "tanglebin/pictures/palette.hpp"

#include "tanglebin/base/error.hpp"
#include "tanglebin/cloud/label_colors.hpp"

namespace tanglebin {

std::vector<Color> palette(std::int32_t largest_label, const std::string& name) {
  constexpr std::int32_t largest_allowed = 100'000;
  if (largest_label > largest_allowed) {
    throw InputError({.file = name, .line = 0, .field = "label"}, std::to_string(largest_label),
                     "labels up to " + std::to_string(largest_allowed));
  }
  return label_colors(largest_label);
}

}  // namespace tanglebin
