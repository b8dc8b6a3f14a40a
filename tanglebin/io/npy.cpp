#include "tanglebin/io/npy.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/text.hpp"
#include "tanglebin/io/grey_png.hpp"

namespace tanglebin {
namespace {

using cloud_format::CloudInput;

constexpr std::string_view magic = "\x93NUMPY";
constexpr std::size_t longest_header = 65535;  // bytes

// ---- the literal of a Python dictionary: {'descr': '<f4', 'fortran_order': False, 'shape': (3, 4), }

struct Dictionary {
  std::optional<std::string> descr;
  std::optional<bool> fortran_order;
  std::optional<std::vector<std::size_t>> shape;
};

class DictionaryParser {
public:
  DictionaryParser(std::string_view text, std::string file) : rest_(text), file_(std::move(file)) {}

  Dictionary parse() {
    Dictionary dictionary;
    expect("{");
    while (!take("}")) {
      parse_entry(dictionary);
      if (take(",")) continue;
      expect("}");
      break;
    }
    skip_blanks();
    if (!rest_.empty()) fail("the end of the header");
    return dictionary;
  }

private:
  void parse_entry(Dictionary& dictionary) {
    const std::string key = quoted("the name of an entry in quotes");
    expect(":");
    if (key == "descr") {
      set(dictionary.descr, key, quoted("the type of all values, such as '<f4'"));
    } else if (key == "fortran_order") {
      set(dictionary.fortran_order, key, boolean());
    } else if (key == "shape") {
      set(dictionary.shape, key, tuple());
    } else {
      throw InputError(place(), "entry " + excerpt(key), "descr, fortran_order and shape");
    }
  }

  template <typename Value>
  void set(std::optional<Value>& to, const std::string& key, Value value) const {
    if (to) throw InputError(place(), key + " twice", "it once");
    to = std::move(value);
  }

  std::string quoted(const std::string& expected) {
    skip_blanks();
    const char quote = rest_.empty() ? '\0' : rest_.front();
    const std::size_t end = quote == '\'' || quote == '"' ? rest_.find(quote, 1) : std::string_view::npos;
    if (end == std::string_view::npos) fail(expected);
    std::string text(rest_.substr(1, end - 1));
    rest_.remove_prefix(end + 1);
    return text;
  }

  bool boolean() {
    if (take("False")) return false;
    if (!take("True")) fail("True or False");
    return true;
  }

  std::vector<std::size_t> tuple() {
    std::vector<std::size_t> numbers;
    expect("(");
    while (!take(")")) {
      numbers.push_back(number());
      if (take(",")) continue;
      expect(")");
      break;
    }
    return numbers;
  }

  std::size_t number() {
    skip_blanks();
    const std::size_t digits = std::min(rest_.find_first_not_of("0123456789"), rest_.size());
    const auto value = to_number<std::uint32_t>(rest_.substr(0, digits));
    if (!value) fail("an integer from 0 to 4294967295");
    rest_.remove_prefix(digits);
    return *value;
  }

  bool take(std::string_view word) {
    skip_blanks();
    if (!rest_.starts_with(word)) return false;
    rest_.remove_prefix(word.size());
    return true;
  }

  void expect(const std::string& word) {
    if (!take(word)) fail(word);
  }

  void skip_blanks() { rest_.remove_prefix(std::min(rest_.find_first_not_of(" \t\n"), rest_.size())); }

  [[noreturn]] void fail(const std::string& expected) const {
    throw InputError(place(), rest_.empty() ? "its end" : excerpt(rest_), expected);
  }

  InputPlace place() const { return {file_, 0, "header"}; }

  std::string_view rest_;
  std::string file_;
};

// ---- what an image may be

NpyType type_of(const CloudInput& input, const std::string& descr) {
  if (descr == "<u2") return NpyType::uint16;
  if (descr == "<f4") return NpyType::float32;
  if (descr == "<f8") return NpyType::float64;
  throw InputError(input.place_in_file("descr"), excerpt(descr),
                   "'<f4', '<f8' or '<u2', little-endian; convert it: numpy.save(file, "
                   "array.astype('<f4'))");
}

void check_shape(const CloudInput& input, const std::vector<std::size_t>& shape) {
  const InputPlace place = input.place_in_file("shape");
  const std::string found = fmt::format("({})", fmt::join(shape, ", "));
  if (shape.size() != 2) throw InputError(place, found, "(rows, columns)");
  if (shape[0] == 0 || shape[1] == 0 || shape[0] * shape[1] > most_pixels)
    throw InputError(place, found, fmt::format("an image of 1 to {} pixels", most_pixels));
}

template <typename Value>
const Value& required(const CloudInput& input, const std::optional<Value>& value, const char* name) {
  if (!value) throw InputError(input.place_in_file("header"), std::string("no entry ") + name);
  return *value;
}

// ---- the bytes before the dictionary

std::string read_text(CloudInput& input, std::size_t size) {
  std::string text(size, '\0');
  if (input.read(reinterpret_cast<std::byte*>(text.data()), size) < size)
    throw InputError(input.place_in_file("header"), "the end of the file");
  return text;
}

std::size_t little_endian(std::string_view bytes) {
  std::size_t value = 0;
  for (std::size_t i = bytes.size(); i-- > 0;) value = value << 8U | static_cast<unsigned char>(bytes[i]);
  return value;
}

std::string read_dictionary(CloudInput& input) {
  const std::string start = read_text(input, magic.size());
  if (start != magic) throw InputError(input.place_in_file(), excerpt(start), "an NPY file");
  const std::string version = read_text(input, 2);
  const int major = static_cast<unsigned char>(version[0]);
  const int minor = static_cast<unsigned char>(version[1]);
  if (major < 1 || major > 3 || minor != 0)
    throw InputError(input.place_in_file("version"), fmt::format("{}.{}", major, minor), "1.0, 2.0 or 3.0");
  const std::size_t size = little_endian(read_text(input, major == 1 ? 2 : 4));
  if (size > longest_header)
    throw InputError(input.place_in_file("header"), fmt::format("{} bytes", size),
                     fmt::format("at most {}", longest_header));
  return read_text(input, size);
}

Dictionary read_header(CloudInput& input) {
  return DictionaryParser(read_dictionary(input), input.file()).parse();
}

// ---- what labels may be

template <typename Integer>
std::vector<std::int64_t> read_integers(CloudInput& input, std::size_t count) {
  std::vector<std::int64_t> values;
  values.reserve(std::min(count, input.remaining() / sizeof(Integer)));
  std::array<Integer, 4096> block;
  while (values.size() < count) {
    const std::size_t wanted = std::min(block.size(), count - values.size());
    const std::size_t bytes =
        input.read(reinterpret_cast<std::byte*>(block.data()), wanted * sizeof(Integer));
    if (bytes < wanted * sizeof(Integer))
      throw InputError(input.place_in_file(),
                       fmt::format("{} labels", values.size() + bytes / sizeof(Integer)),
                       fmt::format("{}, as the header says", count));
    // NOLINTNEXTLINE(bugprone-signed-char-misuse): a label of one byte is a number
    values.insert(values.end(), block.begin(), block.begin() + static_cast<std::ptrdiff_t>(wanted));
  }
  return values;
}

std::vector<std::int64_t> read_integers(CloudInput& input, const std::string& descr, std::size_t count) {
  if (descr == "<i4") return read_integers<std::int32_t>(input, count);
  if (descr == "<i8") return read_integers<std::int64_t>(input, count);
  if (descr == "<i2") return read_integers<std::int16_t>(input, count);
  if (descr == "|i1") return read_integers<std::int8_t>(input, count);
  if (descr == "<u4") return read_integers<std::uint32_t>(input, count);
  if (descr == "<u2") return read_integers<std::uint16_t>(input, count);
  if (descr == "|u1") return read_integers<std::uint8_t>(input, count);
  throw InputError(input.place_in_file("descr"), excerpt(descr),
                   "integers, little-endian; convert them: numpy.save(file, labels.astype('<i4'))");
}

}  // namespace

NpyHeader read_npy_header(CloudInput& input) {
  const Dictionary dictionary = read_header(input);
  const NpyType type = type_of(input, required(input, dictionary.descr, "descr"));
  if (required(input, dictionary.fortran_order, "fortran_order"))
    throw InputError(input.place_in_file("fortran_order"), "columns one after the other (Fortran order)",
                     "rows; convert it: numpy.save(file, numpy.ascontiguousarray(array))");
  const std::vector<std::size_t>& shape = required(input, dictionary.shape, "shape");
  check_shape(input, shape);
  return {type, static_cast<int>(shape[1]), static_cast<int>(shape[0])};
}

std::vector<std::int64_t> read_npy_integers(CloudInput& input) {
  const Dictionary dictionary = read_header(input);
  const std::vector<std::size_t>& shape = required(input, dictionary.shape, "shape");
  if (shape.size() != 1)
    throw InputError(input.place_in_file("shape"), fmt::format("({})", fmt::join(shape, ", ")),
                     "(points,), one label for each");
  std::vector<std::int64_t> values =
      read_integers(input, required(input, dictionary.descr, "descr"), shape[0]);
  if (!input.at_end()) throw InputError(input.place_in_file(), "more bytes after the last label");
  return values;
}

}  // namespace tanglebin
