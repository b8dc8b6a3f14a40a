#include "tanglebin/report/script.hpp"

#include <fmt/format.h>

namespace tanglebin {

std::string script(std::string_view code) {
  return fmt::format("<script>{}</script>\n", code);
}

std::string json_script(const std::string& json) {
  std::string text;
  text.reserve(json.size());
  for (const char c : json) {
    if (c == '<') {
      text += "\\u003c";
    } else {
      text += c;
    }
  }
  return fmt::format("<script type=\"application/json\">{}</script>\n", text);
}

}  // namespace tanglebin
