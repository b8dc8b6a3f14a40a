#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

namespace tanglebin {

/// A place in the input. Empty or zero members are not printed.
struct InputPlace {
  std::string file{};    ///< path as the user gave it
  std::size_t line = 0;  ///< 1-based; 0 if the input has no lines (binary data, command line)
  std::string field{};   ///< name of the value: a key, a column or a property
};

/// Bad input: a file, a recipe or a parameter. The program prints what() on one line and exits with 2. what()
/// reads "file:line: field: problem", where the problem is "found …, expected …" or a plain sentence. It is
/// printable() (text.hpp); place and problem are as given.
class InputError : public std::runtime_error {
public:
  InputError(const InputPlace& place, const std::string& problem);
  InputError(const InputPlace& place, const std::string& found, const std::string& expected);

  const InputPlace& place() const noexcept { return place_; }

  /// what() without the place.
  const std::string& problem() const noexcept { return problem_; }

private:
  InputPlace place_;
  std::string problem_;
};

/// The system refused what was right to ask: the disk is full, a file may not be written, … The same may work
/// later. The program prints what(), "file: problem", on one line and exits with 5.
class SystemError : public std::runtime_error {
public:
  SystemError(const std::string& file, const std::string& problem);

  /// With what() of another.
  explicit SystemError(const std::string& what) : std::runtime_error(what) {}
};

/// Calls `call`, and adds this file to an InputError that names none.
template <typename Call>
auto with_file(const std::string& file, Call call) {
  try {
    return call();
  } catch (const InputError& error) {
    if (!error.place().file.empty()) throw;
    throw InputError({file, error.place().line, error.place().field}, error.problem());
  }
}

/// Calls `call`, which looks up or reads what a value names, and puts the value's place before its
/// InputError.
template <typename Call>
auto with_place(const InputPlace& place, Call call) {
  try {
    return call();
  } catch (const InputError& error) {
    throw InputError(place, error.what());
  }
}

}  // namespace tanglebin
