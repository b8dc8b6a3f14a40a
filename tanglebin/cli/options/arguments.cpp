#include "tanglebin/cli/options/arguments.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <utility>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/text.hpp"
#include "tanglebin/dataset/dataset.hpp"

namespace tanglebin::cli {
namespace {

std::optional<int> parse_positive(std::string_view text) {
  const auto value = to_number<int>(text);
  return value && *value >= 1 ? value : std::nullopt;
}

// The two numbers on either side of a separator.
std::optional<std::pair<int, int>> parse_pair(std::string_view text, char separator) {
  const std::size_t middle = text.find(separator);
  if (middle == std::string_view::npos) return std::nullopt;
  const auto first = parse_positive(text.substr(0, middle));
  const auto second = parse_positive(text.substr(middle + 1));
  if (!first || !second) return std::nullopt;
  return std::pair{*first, *second};
}

std::optional<Range> parse_range(std::string_view text) {
  if (const auto one = parse_positive(text)) return Range{*one, *one};
  const auto two = parse_pair(text, '-');
  if (!two || two->first > two->second) return std::nullopt;
  return Range{two->first, two->second};
}

// Ratios are counted in billionths, so that 0.1 plus two steps of 0.1 is exactly 0.3.
constexpr double billion = 1e9;

std::optional<std::int64_t> parse_billionths(std::string_view text) {
  const auto value = to_number<double>(text);
  if (!value || !(*value > 0 && *value <= 1)) return std::nullopt;
  const std::int64_t billionths = std::llround(*value * billion);
  if (static_cast<double>(billionths) / billion != *value) return std::nullopt;
  return billionths;
}

std::optional<double> parse_length(std::string_view text) {
  const auto value = to_number<double>(text);
  return value && std::isfinite(*value) && *value > 0 ? value : std::nullopt;
}

}  // namespace

void write_output(const std::string& file, std::string_view bytes) {
  if (file != standard_stream) {
    write_file(file, bytes);
    return;
  }
  std::fwrite(bytes.data(), 1, bytes.size(), stdout);  // main() checks that it was written
}

void write_outputs(const std::vector<std::pair<std::string, std::string>>& outputs) {
  std::vector<std::pair<std::filesystem::path, std::string>> files;
  for (const auto& [file, bytes] : outputs) {
    if (file != standard_stream) files.emplace_back(file, bytes);
  }
  write_files(files);
  for (const auto& [file, bytes] : outputs) {
    if (file == standard_stream) write_output(file, bytes);
  }
}

void expect_dataset(const std::string& directory) {
  const std::filesystem::path path(directory);
  if (std::filesystem::exists(path / recipe_name)) return;
  const std::string found = !std::filesystem::exists(path)         ? "nothing"
                            : !std::filesystem::is_directory(path) ? "a file"
                                                                   : "no recipe.toml in it";
  throw InputError({directory, 0, ""}, found, "the directory of a dataset from `tanglebin generate`");
}

Method method_of(const std::string& name) {
  return with_option("--method", "method", [&] { return method_named(name); });
}

std::vector<Range> parse_numbers(std::string_view text, const std::string& option) {
  std::vector<Range> ranges;
  for (const std::string_view part : split(text, ',')) {
    const std::optional<Range> range = parse_range(part);
    if (!range)
      throw InputError({"", 0, option}, excerpt(part), "numbers from 1, and ranges, such as 1,5,10-20");
    ranges.push_back(*range);
  }
  return ranges;
}

bool contains(const std::vector<Range>& ranges, int number) {
  return std::ranges::any_of(
      ranges, [number](const Range& range) { return range.first <= number && number <= range.last; });
}

std::uint64_t parse_seed(std::string_view text, const std::string& option) {
  constexpr int decimal = 10;
  constexpr int hexadecimal = 16;
  const bool is_hexadecimal = text.starts_with("0x");
  const std::string_view digits = is_hexadecimal ? text.substr(2) : text;
  const char* const last = digits.data() + digits.size();
  std::uint64_t seed = 0;
  const auto [end, error] =
      std::from_chars(digits.data(), last, seed, is_hexadecimal ? hexadecimal : decimal);
  if (error != std::errc{} || end != last)
    throw InputError({"", 0, option}, excerpt(text),
                     "a seed of at most 64 bits: decimal, or hexadecimal after 0x");
  return seed;
}

std::vector<double> parse_lengths(std::string_view text, const std::string& option) {
  std::vector<double> lengths;
  for (const std::string_view part : split(text, ',')) {
    const std::optional<double> length = parse_length(part);
    if (!length) throw InputError({"", 0, option}, excerpt(part), "a positive number");
    lengths.push_back(*length);
  }
  return lengths;
}

SegmentTree parse_tree(std::string_view text, const std::string& option) {
  SegmentTree tree;
  for (const std::string_view part : split(text, ',')) {
    const std::size_t colon = std::min(part.find(':'), part.size());
    const auto nodes = parse_pair(part.substr(0, colon), '-');
    const auto length = parse_length(part.substr(std::min(colon + 1, part.size())));
    if (!nodes || !length)
      throw InputError({"", 0, option}, excerpt(part),
                       "a segment with its length in metres, such as 1-2:0.3");
    tree.push_back({nodes->first, nodes->second, *length});
  }
  validate(tree, option);
  return tree;
}

std::vector<double> parse_ratios(std::string_view text, const std::string& option) {
  const auto expect = [&](bool holds, std::string_view found, const std::string& expected) {
    if (!holds) throw InputError({"", 0, option}, excerpt(found), expected);
  };
  const auto billionths_of = [&](std::string_view part) {
    const auto billionths = parse_billionths(part);
    expect(billionths.has_value(), part, "a ratio above 0 and at most 1, with at most nine decimals");
    return *billionths;
  };

  const std::vector<std::string_view> range = split(text, ':');
  std::vector<std::int64_t> ratios;
  if (range.size() == 1) {
    for (const std::string_view part : split(text, ',')) ratios.push_back(billionths_of(part));
  } else {
    expect(range.size() == 3, text, "ratios such as 0.1,0.3 or first:last:step such as 0.1:1.0:0.1");
    const std::int64_t first = billionths_of(range[0]);
    const std::int64_t last = billionths_of(range[1]);
    const std::int64_t step = billionths_of(range[2]);
    expect(first <= last && (last - first) % step == 0, text,
           "a step that leads from the first ratio to the last");
    constexpr std::int64_t most_steps = 999;
    expect((last - first) / step <= most_steps, text, "at most a thousand ratios");
    for (std::int64_t ratio = first; ratio <= last; ratio += step) ratios.push_back(ratio);
  }
  std::ranges::sort(ratios);
  expect(std::ranges::adjacent_find(ratios) == ratios.end(), text, "each ratio once");

  std::vector<double> result;
  result.reserve(ratios.size());
  for (const std::int64_t ratio : ratios) result.push_back(static_cast<double>(ratio) / billion);
  return result;
}

Shard parse_shard(std::string_view text, const std::string& option) {
  const auto parts = parse_pair(text, '/');
  if (!parts || parts->first > parts->second) {
    throw InputError({"", 0, option}, excerpt(text), "I/N with I from 1 to N, such as 2/8, or auto");
  }
  return {parts->first, parts->second};
}

}  // namespace tanglebin::cli
