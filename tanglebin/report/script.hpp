#pragma once

#include <string>
#include <string_view>

// Scripts on an HTML page.
namespace tanglebin {

/// A <script> element with code that has no "</script".
std::string script(std::string_view code);

/// A <script> element with JSON, for other scripts to read. Escapes what could end it.
std::string json_script(const std::string& json);

}  // namespace tanglebin
