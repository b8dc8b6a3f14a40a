#pragma once

#include <png.h>

#include <string>

// Internal to the room. libpng is C and reports errors with a jump back to the function that called setjmp().
// So no exception may pass through it (running out of memory in a callback ends the program), and everything
// that owns memory belongs to that function's caller.
namespace tanglebin {

/// libpng's error function, where its error pointer is a std::string: keeps the message there and jumps.
[[noreturn]] inline void keep_png_error(png_structp png, png_const_charp message) noexcept {
  *static_cast<std::string*>(png_get_error_ptr(png)) = message;
  png_longjmp(png, 1);
}

inline void ignore_png_warning(png_structp /*png*/, png_const_charp /*message*/) noexcept {}

}  // namespace tanglebin
