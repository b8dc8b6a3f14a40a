#include "tanglebin/report/document.hpp"

#include <fmt/format.h>

#include "tanglebin/report/embedded.hpp"
#include "tanglebin/report/html.hpp"
#include "tanglebin/report/page_style.hpp"

namespace tanglebin {

std::string html_document(std::string_view title, const std::string& head_html,
                          const std::string& body_html) {
  return fmt::format(
      "<!DOCTYPE html>\n<!--\n{}-->\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n"
      "<title>{}</title>\n<style>{}</style>\n{}</head>\n<body>\n{}</body>\n</html>\n",
      embedded::licences_txt, escaped(title), page_style, head_html, body_html);
}

}  // namespace tanglebin
