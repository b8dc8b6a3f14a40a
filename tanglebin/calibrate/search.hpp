#pragma once

#include <functional>
#include <vector>

namespace tanglebin {

/// A point of the unit cube.
using CubePoint = std::vector<double>;

/// How to look for the greatest value of a function near a point.
struct CubeSearch {
  CubePoint start;
  double step = 0.1;     ///< of the first steps
  double finest = 0.01;  ///< it ends where it takes smaller ones
  int most = 1000;       ///< values to look at
};

/// Calls `value` for points of the unit cube to find the greatest, which the caller keeps. What it throws
/// ends the search. Subplex (Rowan 1990; NLopt's SBPLX), which only asks which of two values is greater: so a
/// function may be rough, and the values of bad points inexact.
void search_cube(const CubeSearch& search, const std::function<double(const CubePoint&)>& value);

}  // namespace tanglebin
