#pragma once

#include <CLI/CLI.hpp>

// Checks of options that CLI11 converts to numbers.
namespace tanglebin::cli {

/// A whole number from `least` to `most`.
CLI::Validator whole_number(int least, int most);

/// A finite number.
CLI::Validator finite_number();

/// A number from `least` to `most`.
CLI::Validator number_within(double least, double most);

}  // namespace tanglebin::cli
