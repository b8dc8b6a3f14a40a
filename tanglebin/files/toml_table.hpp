#pragma once

// toml++ 3.3 asserts that "[[[a]]" cannot be, and reports it properly in the lines below the assertion.
#define TOML_ASSERT(expression) static_assert(true)
#define TOML_ENABLE_FORMATTERS 0
#include <toml++/toml.h>

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tanglebin/base/error.hpp"

namespace tanglebin {

/// A number as a TOML float, in its shortest form: "1.0", "-0.0", "1e-05".
std::string real_text(double value);

/// What a node is, for messages: "a table", "1.5", "'some text'".
std::string description(const toml::node& node);

/// The path of a key in the table with the path `table`: "bin.height"; of the root's, "seed".
std::string path_of(std::string_view table, std::string_view key);

/// Calls `visit(path, node)` for a node and, as long as it returns true, for what is in the node: "set",
/// "set[0]", "set[0].name", … Calls itself once per level, of which parse_toml() allows few.
void for_each_node(const toml::node& node, const std::string& path,
                   const std::function<bool(const std::string&, const toml::node&)>& visit);

/// A TOML file's name and the lines of everything in it, for messages. Copies of a parsed tree have no lines.
class TomlSource {
public:
  /// A tree that comes from no file: no lines are known.
  TomlSource() = default;

  TomlSource(std::string file, const toml::table& root);

  const std::string& file() const { return file_; }

  /// Where the value of this path begins; 0 if unknown.
  std::size_t line(const std::string& path) const;

  /// The same of what validate() calls a field, or else of the innermost table around it. An angle's key has
  /// its unit.
  std::size_t line_of_field(std::string field) const;

  /// Gives a value, and everything in it, the lines of another, of which it is a copy.
  void take_lines(const std::string& path, const std::string& original);

private:
  std::string file_;
  std::map<std::string, std::size_t> lines_;
};

/// Parses TOML. Strings are UTF-8; outside of them and of comments, all is ASCII. Throws InputError with file
/// and line, also if brackets and dots are nested more than 64 deep.
toml::table parse_toml(const std::string& text, const std::string& name);

/// Calls `call`, which validates what was read, and adds the file, and the line of the field or else of the
/// innermost table around it, to its InputError.
void validate_at(const TomlSource& source, const std::function<void()>& call);

/// Reads a table of a TOML tree strictly: every error is an InputError with the file, the line and the key's
/// whole path. Refers to the source and the tree; they must outlive it.
class TomlTable {
public:
  /// `path` is the table's own: "set[0].tube", empty for the root.
  TomlTable(const TomlSource& source, const toml::table& table, std::string path);

  /// The path of a key in this table.
  std::string path_of(std::string_view key) const { return tanglebin::path_of(path_, key); }

  bool has(std::string_view key) const { return find(key) != nullptr; }

  /// Throws for a key that is not in `known`, with a guess which was meant.
  void allow(const std::vector<std::string_view>& known) const;

  /// Throws for the first of `keys` that is missing.
  void require(std::initializer_list<std::string_view> keys) const;

  /// Throws if the table has more than one of `keys`.
  void allow_one_of(std::initializer_list<std::string_view> keys) const;

  /// Sets `value` to that of a key, or leaves it if there is no such key. Real numbers may be written as
  /// integers; they must be finite.
  void get(std::string_view key, double& value) const;
  void get(std::string_view key, int& value) const;
  void get(std::string_view key, std::uint64_t& value) const;  ///< up to 2⁶³ − 1, TOML's greatest
  void get(std::string_view key, bool& value) const;
  void get(std::string_view key, std::string& value) const;
  void get(std::string_view key, std::vector<int>& values) const;
  void get(std::string_view key, Eigen::Vector3d& values) const;
  void get(std::string_view key, Eigen::Vector4d& values) const;
  void get(std::string_view key, Eigen::Matrix3d& values) const;  ///< an array of rows
  void get(std::string_view key, Eigen::Matrix4d& values) const;  ///< an array of rows

  /// The table under `key`; an empty one if there is none.
  TomlTable table(std::string_view key) const;

  /// The table under `key` as it is; nullptr if there is none.
  const toml::table* raw_table(std::string_view key) const;

  /// The tables of the array under `key`, if any.
  std::vector<TomlTable> tables(std::string_view key) const;

  /// Is there a string under `key`?
  bool is_string(std::string_view key) const { return has(key) && find(key)->is_string(); }

  /// Is there an array under `key`?
  bool is_array(std::string_view key) const { return has(key) && find(key)->is_array(); }

  const std::string& file() const { return source_.file(); }
  const TomlSource& source() const { return source_; }

  /// Where a key's value begins; for a missing key, where the table begins.
  std::size_t line(std::string_view key) const;

  /// Of a key's value, for messages.
  InputPlace place(std::string_view key) const { return {file(), line(key), path_of(key)}; }

  [[noreturn]] void fail(std::string_view key, const std::string& found, const std::string& expected) const;

private:
  const toml::node* find(std::string_view key) const { return table_.get(key); }

  // A node, the key that errors name (an array element's is the array's), and the node's own path.
  struct Value {
    const toml::node& node;
    std::string_view key;
    std::string path;
  };
  std::optional<Value> value_of(std::string_view key) const;
  std::vector<Value> elements(const Value& value, const std::string& expected) const;

  double real(const Value& value) const;
  std::int64_t integer(const Value& value, std::int64_t least, std::int64_t most) const;
  template <int Size>
  Eigen::Matrix<double, Size, 1> vector(const Value& value) const;
  template <int Size>
  void get_rows(std::string_view key, Eigen::Matrix<double, Size, Size>& values) const;
  template <typename Type>
  const Type& as(const Value& value, const std::string& expected) const;
  [[noreturn]] void fail(const Value& value, const std::string& found, const std::string& expected) const;

  const TomlSource& source_;
  const toml::table& table_;
  std::string path_;
};

}  // namespace tanglebin
