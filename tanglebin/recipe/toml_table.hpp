#pragma once

// toml++ 3.3 asserts that "[[[a]]" cannot be, and reports it properly in the lines below the assertion.
#define TOML_ASSERT(expression) static_assert(true)
#define TOML_ENABLE_FORMATTERS 0
#include <toml++/toml.h>

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace tanglebin {

/// A number as a TOML float, in its shortest form: "1.0", "-0.0", "1e-05".
std::string real_text(double value);

/// A table of a TOML file read strictly: every error is an InputError with the file, the line and the key's
/// whole path. Refers to the file's name and the parsed table; they must outlive it.
class TomlTable {
public:
  /// `path` is the table's own: "set[0].tube", empty for the root.
  TomlTable(const std::string& file, const toml::table& table, std::string path);

  bool has(std::string_view key) const { return find(key) != nullptr; }

  /// Throws for a key that is none of `known`, and guesses which was meant.
  void allow(const std::vector<std::string_view>& known) const;

  /// Throws for the first of `keys` that is missing.
  void require(std::initializer_list<std::string_view> keys) const;

  /// Throws if more than one of `keys` is there.
  void allow_one_of(std::initializer_list<std::string_view> keys) const;

  /// Sets `value` to that of a key; leaves it as it is where there is no such key. Real numbers may be
  /// written as integers; they must be finite.
  void get(std::string_view key, double& value) const;
  void get(std::string_view key, int& value) const;
  void get(std::string_view key, std::uint64_t& value) const;  ///< up to 2⁶³ − 1, TOML's greatest
  void get(std::string_view key, bool& value) const;
  void get(std::string_view key, std::string& value) const;
  void get(std::string_view key, std::vector<int>& values) const;
  void get(std::string_view key, Eigen::Vector3d& values) const;
  void get(std::string_view key, Eigen::Vector4d& values) const;
  void get(std::string_view key, Eigen::Matrix3d& values) const;  ///< an array of rows

  /// The table under `key`; an empty one where there is none.
  TomlTable table(std::string_view key) const;

  /// The tables of the array under `key`; none where there is none.
  std::vector<TomlTable> tables(std::string_view key) const;

  /// Is there an array under `key`?
  bool is_array(std::string_view key) const { return has(key) && find(key)->is_array(); }

  const std::string& file() const { return file_; }

  /// Where a key's value begins; where the table begins for a key that is not there.
  std::size_t line(std::string_view key) const;

  [[noreturn]] void fail(std::string_view key, const std::string& found, const std::string& expected) const;

private:
  const toml::node* find(std::string_view key) const { return table_.get(key); }
  std::string path_of(std::string_view key) const;

  // A node and the key that an error in it names: its own, or that of the array around it.
  struct Value {
    const toml::node& node;
    std::string_view key;
  };
  double real(const Value& value) const;
  std::int64_t integer(const Value& value, std::int64_t least, std::int64_t most) const;
  template <int Size>
  Eigen::Matrix<double, Size, 1> vector(const Value& value) const;
  const toml::array& array(const Value& value, const std::string& expected) const;
  template <typename Type>
  const Type& as(const Value& value, const std::string& expected) const;
  [[noreturn]] void fail(const Value& value, const std::string& found, const std::string& expected) const;

  const std::string& file_;
  const toml::table& table_;
  std::string path_;
};

}  // namespace tanglebin
