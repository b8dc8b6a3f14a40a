#include "tanglebin/dataset/excerpt.hpp"

namespace tanglebin {

std::string excerpt(std::string_view text) {
  constexpr std::size_t longest = 40;
  const auto printable = [](char c) { return c >= ' ' && c <= '~'; };
  std::string result = "'";
  for (const char c : text.substr(0, longest)) result += printable(c) ? c : '?';
  return result + (text.size() > longest ? "…'" : "'");
}

}  // namespace tanglebin
