#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tanglebin/base/error.hpp"
#include "tanglebin/files/safe_file.hpp"
#include "tanglebin/model/model_tubes.hpp"
#include "tanglebin/model/scene/segment_tree.hpp"
#include "tanglebin/runs/shard.hpp"

namespace tanglebin::cli {

/// Stands for standard input or output, instead of a file name.
inline constexpr const char* standard_stream = "-";

/// Calls `read` with the file's path, or with standard input and its name if `file` is "-".
template <typename Read>
auto read_input(const std::string& file, const Read& read) {
  if (file == standard_stream) return read(std::cin, std::string("standard input"));
  return read(std::filesystem::path(file));
}

/// Writes the bytes to the file, completely or not at all, or to standard output if `file` is "-".
void write_output(const std::string& file, std::string_view bytes);

/// Writes several outputs, each a file's name and its bytes. If one cannot be written, no file is.
void write_outputs(const std::vector<std::pair<std::string, std::string>>& outputs);

/// Throws InputError unless the directory has a dataset, that is a recipe.toml.
void expect_dataset(const std::string& directory);

/// Calls `call`, which knows an option's value by the name of a field: an InputError about the field names
/// the option.
template <typename Call>
auto with_option(const std::string& option, const std::string& field, Call call) {
  try {
    return call();
  } catch (const InputError& error) {
    if (error.place().field != field) throw;
    throw InputError({"", 0, option}, error.problem());
  }
}

/// The method of --method. Throws InputError naming the option for any other name.
Method method_of(const std::string& name);

/// A range of whole numbers, both ends included.
struct Range {
  int first;
  int last;
};

/// Parses whole numbers from 1, and ranges of them: "3", "1-20", "1,5,10-20". Throws InputError naming
/// `option` for anything else.
std::vector<Range> parse_numbers(std::string_view text, const std::string& option);

/// Whether a number is in one of the ranges.
bool contains(const std::vector<Range>& ranges, int number);

/// Parses a seed of at most 64 bits, decimal or hexadecimal: "31" or "0x1f". Throws InputError naming
/// `option` for anything else.
std::uint64_t parse_seed(std::string_view text, const std::string& option);

/// Parses positive numbers: "0.4" or "0.4,0.5". Throws InputError naming `option` for anything else.
std::vector<double> parse_lengths(std::string_view text, const std::string& option);

/// Parses segments between nodes, with their lengths: "1-2:0.3,1-3:0.1". Throws InputError naming `option`
/// for anything else.
SegmentTree parse_tree(std::string_view text, const std::string& option);

/// Parses ratios: "0.1,0.3" or "0.1:1.0:0.1" (first:last:step, both ends included). Returns the double
/// nearest to each decimal number, ascending. Throws InputError naming `option` for anything else: a ratio
/// outside (0, 1] or with more than nine decimals, a duplicate, a step that does not lead from first to last,
/// or more than a thousand ratios.
std::vector<double> parse_ratios(std::string_view text, const std::string& option);

/// Parses "2/8". Throws InputError naming `option` for anything else.
Shard parse_shard(std::string_view text, const std::string& option);

}  // namespace tanglebin::cli
