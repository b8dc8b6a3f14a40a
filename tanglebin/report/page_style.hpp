#pragma once

namespace tanglebin {

/// The report's style sheet: for phones, desks and paper, light and dark.
extern const char* const page_style;

}  // namespace tanglebin
