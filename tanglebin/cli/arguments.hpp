#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <string>
#include <string_view>
#include <vector>

#include "tanglebin/io/safe_file.hpp"
#include "tanglebin/model/scene/segment_tree.hpp"
#include "tanglebin/runs/shard.hpp"

namespace tanglebin::cli {

/// What stands for standard input or output in place of a file's name.
inline constexpr const char* standard_stream = "-";

/// Calls `read` with the file's path, or with standard input and a name for it where `file` is "-".
template <typename Read>
auto read_input(const std::string& file, const Read& read) {
  if (file == standard_stream) return read(std::cin, std::string("standard input"));
  return read(std::filesystem::path(file));
}

/// Writes the bytes to the file, whole or not at all, or to standard output where `file` is "-".
void write_output(const std::string& file, std::string_view bytes);

/// A range of whole numbers, both ends in it.
struct Range {
  int first;
  int last;
};

/// "3" or "3-7". Throws InputError naming `option` for anything else.
Range parse_range(std::string_view text, const std::string& option);

/// "1f" is 31. Throws InputError naming `option` for anything but a hexadecimal number of at most 64 bits.
std::uint64_t parse_hexadecimal(std::string_view text, const std::string& option);

/// "0.4" or "0.4,0.5": positive numbers. Throws InputError naming `option` for anything else.
std::vector<double> parse_lengths(std::string_view text, const std::string& option);

/// "1-2:0.3,1-3:0.1": segments between nodes and how long they are. Throws InputError naming `option` for
/// anything else.
SegmentTree parse_tree(std::string_view text, const std::string& option);

/// "0.1,0.3" or "0.1:1.0:0.1" (first:last:step, both ends in it): the double nearest to each decimal number,
/// ascending. Throws InputError naming `option` for anything else: a ratio that is not in (0, 1] or has more
/// than nine decimals, one that is there twice, a step that does not lead from first to last, more than a
/// thousand ratios.
std::vector<double> parse_ratios(std::string_view text, const std::string& option);

/// "2/8". Throws InputError naming `option` for anything else.
Shard parse_shard(std::string_view text, const std::string& option);

}  // namespace tanglebin::cli
