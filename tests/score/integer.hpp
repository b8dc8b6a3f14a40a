#pragma once

#include <rapidcheck.h>

namespace tanglebin {

/// An integer in [low, high), where rapidcheck alone would begin with the low ones of the range.
template <class T>
rc::Gen<T> integer(T low, T high) {
  return rc::gen::resize(rc::kNominalSize, rc::gen::inRange(low, high));
}

}  // namespace tanglebin
