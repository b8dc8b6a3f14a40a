#pragma once

#include <string>
#include <string_view>

namespace tanglebin {

/// An HTML document in the house's style, with the licences of what it may embed. `head_html` follows the
/// style in its head.
std::string html_document(std::string_view title, const std::string& head_html, const std::string& body_html);

}  // namespace tanglebin
