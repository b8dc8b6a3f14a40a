#include "tanglebin/io/point_records.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

#include "tanglebin/base/text.hpp"
#include "tanglebin/geometry/labels.hpp"

namespace tanglebin::cloud_format {
namespace {

// Records are decoded column by column while they are in the processor's second-level cache.
constexpr std::size_t run_bytes = std::size_t{1} << 16;

// PCL's invalid label, −1 in an unsigned field.
constexpr std::uint32_t unsigned_null_label = std::numeric_limits<std::uint32_t>::max();

// Calls visitor(std::type_identity<T>) with the C++ type of a scalar.
template <class Visitor>
decltype(auto) visit(Scalar type, Visitor&& visitor) {
  switch (type) {
    case Scalar::int8:
      return visitor(std::type_identity<std::int8_t>());
    case Scalar::uint8:
      return visitor(std::type_identity<std::uint8_t>());
    case Scalar::int16:
      return visitor(std::type_identity<std::int16_t>());
    case Scalar::uint16:
      return visitor(std::type_identity<std::uint16_t>());
    case Scalar::int32:
      return visitor(std::type_identity<std::int32_t>());
    case Scalar::uint32:
      return visitor(std::type_identity<std::uint32_t>());
    case Scalar::int64:
      return visitor(std::type_identity<std::int64_t>());
    case Scalar::uint64:
      return visitor(std::type_identity<std::uint64_t>());
    case Scalar::float32:
      return visitor(std::type_identity<float>());
    case Scalar::float64:
      return visitor(std::type_identity<double>());
  }
  std::abort();
}

std::endian byte_order(Encoding encoding) {
  switch (encoding) {
    case Encoding::ascii:
      return std::endian::native;  // parse_value() stores numbers in memory order
    case Encoding::little_endian:
      return std::endian::little;
    case Encoding::big_endian:
      return std::endian::big;
  }
  std::abort();
}

template <class T>
T load(const std::byte* from, std::endian order) {
  std::array<std::byte, sizeof(T)> bytes;
  std::memcpy(bytes.data(), from, sizeof(T));
  if (order != std::endian::native) std::ranges::reverse(bytes);
  return std::bit_cast<T>(bytes);
}

// Calls store(point, value) for each value of a column.
template <class T, class Store>
void for_each_value(Column column, std::endian order, Store store) {
  for (std::size_t i = 0; i < column.count; ++i) {
    store(column.first_point + i, load<T>(column.bytes + i * column.stride, order));
  }
}

// ---- text

template <class T>
std::string what_fits() {
  if constexpr (std::is_integral_v<T>) {
    return fmt::format("an integer from {} to {}", std::numeric_limits<T>::min(),
                       std::numeric_limits<T>::max());
  } else {
    return fmt::format("a {}-bit floating-point number", 8 * sizeof(T));
  }
}

template <class T>
T parse(const CloudInput& input, const Property& property, std::string_view word) {
  const auto value = to_number<T>(word);
  if (!value) throw InputError(input.place(property.name), excerpt(word), what_fits<T>());
  return *value;
}

// Stores the number in memory order.
void parse_value(const CloudInput& input, const Property& property, std::string_view word, std::byte* to) {
  visit(property.type, [&]<class T>(std::type_identity<T>) {
    const T value = parse<T>(input, property, word);
    std::memcpy(to, &value, sizeof(T));
  });
}

// The number of words that a line of this element must have, including the lengths of lists.
std::size_t words_due(const CloudInput& input, const Element& element,
                      const std::vector<std::string_view>& words) {
  std::size_t due = 0;
  for (const Property& property : element.properties) {
    const bool has_length = property.length_type && due < words.size();
    if (has_length) due += parse<std::uint32_t>(input, property, words[due]);
    due += property.count;  // for a list: its length
  }
  return due;
}

void parse_record(const CloudInput& input, const Element& element, const std::vector<std::string_view>& words,
                  std::byte* record) {
  const std::size_t due = words_due(input, element, words);
  if (words.size() != due) {
    throw InputError(input.place(), fmt::format("{} values", words.size()), std::to_string(due));
  }
  std::size_t word = 0;
  for (const Property& property : element.properties) {
    if (property.length_type) word += parse<std::uint32_t>(input, property, words[word]);
    if (property.meaning != Meaning::other) parse_value(input, property, words[word], record);
    word += property.count;
    record += size_of(property);
  }
}

std::size_t read_text_run(CloudInput& input, const Element& element, std::byte* records, std::size_t count) {
  const std::size_t size = record_size(element);
  std::vector<std::string_view> words;
  for (std::size_t i = 0; i < count; ++i) {
    const auto line = input.next_line();
    if (!line) return i;
    words_of(*line, words);
    parse_record(input, element, words, records + i * size);
  }
  return count;
}

// ---- binary

bool has_lists(const Element& element) {
  return std::ranges::any_of(element.properties, [](const Property& p) { return p.length_type.has_value(); });
}

// False at the end of the file.
bool skip_list(CloudInput& input, std::endian order, const Property& list) {
  std::array<std::byte, sizeof(std::int64_t)> bytes;
  const std::size_t length_size = size_of(*list.length_type);
  if (input.read(bytes.data(), length_size) < length_size) return false;
  const auto length = visit(*list.length_type, [&]<class T>(std::type_identity<T>) {
    return static_cast<std::int64_t>(load<T>(bytes.data(), order));
  });
  if (length < 0) {
    throw InputError(input.place_in_file(list.name), fmt::format("a list of length {}", length), "0 or more");
  }
  const std::size_t size = static_cast<std::size_t>(length) * size_of(list.type);
  return input.skip(size) == size;
}

// False at the end of the file.
bool read_record_with_lists(CloudInput& input, std::endian order, const Element& element, std::byte* record) {
  return std::ranges::all_of(element.properties, [&](const Property& property) {
    if (property.length_type) return skip_list(input, order, property);
    const std::size_t size = size_of(property);
    const bool complete = input.read(record, size) == size;
    record += size;
    return complete;
  });
}

std::size_t read_binary_run(CloudInput& input, Encoding encoding, const Element& element, std::byte* records,
                            std::size_t count) {
  const std::size_t size = record_size(element);
  if (!has_lists(element)) return input.read(records, count * size) / size;
  for (std::size_t i = 0; i < count; ++i) {
    if (!read_record_with_lists(input, byte_order(encoding), element, records + i * size)) return i;
  }
  return count;
}

// ---- values

// A value of the file as a label, if it is a valid one.
template <class T>
std::optional<std::int32_t> as_label(T value) {
  if (std::in_range<std::int32_t>(value) && std::cmp_greater_equal(value, null_label))
    return static_cast<std::int32_t>(value);
  if constexpr (std::is_same_v<T, std::uint32_t>) {
    if (value == unsigned_null_label) return null_label;
  }
  return std::nullopt;
}

Color unpacked(std::uint32_t rgb) {
  return {static_cast<std::uint8_t>(rgb >> 16), static_cast<std::uint8_t>(rgb >> 8),
          static_cast<std::uint8_t>(rgb)};
}

}  // namespace

std::size_t size_of(Scalar type) {
  return visit(type, []<class T>(std::type_identity<T>) { return sizeof(T); });
}

bool is_integer(Scalar type) {
  return visit(type, []<class T>(std::type_identity<T>) { return std::is_integral_v<T>; });
}

bool can_be(Meaning meaning, Scalar type) {
  switch (meaning) {
    case Meaning::x:
    case Meaning::y:
    case Meaning::z:
    case Meaning::normal_x:
    case Meaning::normal_y:
    case Meaning::normal_z:
      return !is_integer(type);
    case Meaning::red:
    case Meaning::green:
    case Meaning::blue:
      return type == Scalar::uint8;
    case Meaning::packed_rgb:
      return type == Scalar::float32 || type == Scalar::uint32;
    case Meaning::label:
    case Meaning::mixed:
      return is_integer(type);
    case Meaning::intensity:
    case Meaning::other:
      return true;
  }
  std::abort();
}

const Property* find(const Element& element, Meaning meaning) {
  const auto found = std::ranges::find(element.properties, meaning, &Property::meaning);
  return found == element.properties.end() ? nullptr : &*found;
}

std::size_t size_of(const Property& property) {
  return property.length_type ? 0 : property.count * size_of(property.type);
}

std::size_t record_size(const Element& element) {
  std::size_t size = 0;
  for (const Property& property : element.properties) size += size_of(property);
  return size;
}

void read_records(CloudInput& input, Encoding encoding, const Element& element,
                  const std::function<void(const Records&)>& consume) {
  const std::size_t size = std::max<std::size_t>(record_size(element), 1);  // 0: only lists
  const std::size_t run = std::max<std::size_t>(run_bytes / size, 1);
  std::vector<std::byte> bytes(std::min(run, element.count) * size);
  for (std::size_t first = 0; first < element.count; first += run) {
    const std::size_t wanted = std::min(run, element.count - first);
    const std::size_t count = encoding == Encoding::ascii
                                  ? read_text_run(input, element, bytes.data(), wanted)
                                  : read_binary_run(input, encoding, element, bytes.data(), wanted);
    if (count < wanted) {
      throw InputError(input.place_in_file(element.name),
                       fmt::format("{} before the end of the file", first + count),
                       std::to_string(element.count));
    }
    consume({bytes.data(), first, count});
  }
}

void expect_no_more_lines(CloudInput& input) {
  while (const auto line = input.next_line()) {
    if (!words_of(*line).empty()) throw InputError(input.place(), excerpt(*line), "the end of the file");
  }
}

PointDecoder::PointDecoder(const CloudInput& input, const Element& element, Encoding encoding)
    : file_(input.file()),
      element_(element),
      order_(byte_order(encoding)),
      first_line_(encoding == Encoding::ascii ? input.line() + 1 : 0) {}

void PointDecoder::reserve(std::size_t bytes) {
  const std::size_t points =
      std::min(element_.count, bytes / std::max<std::size_t>(record_size(element_), 1));
  cloud_.points.reserve(points);
  if (has(Meaning::label)) cloud_.labels.reserve(points);
  if (has_colors()) cloud_.colors.reserve(points);
  if (has_normals()) cloud_.normals.reserve(points);
  if (has(Meaning::intensity)) cloud_.intensities.reserve(points);
  if (has(Meaning::mixed)) cloud_.mixed.reserve(points);
}

void PointDecoder::add_records(const Records& records) {
  grow(records.first + records.count);
  const std::byte* first = records.bytes;
  for (const Property& property : element_.properties) {
    decode(property, {first, record_size(element_), records.first, records.count});
    first += size_of(property);
  }
}

void PointDecoder::add_planes(const std::byte* planes) {
  grow(element_.count);
  for (const Property& property : element_.properties) {
    decode(property, {planes, size_of(property), 0, element_.count});
    planes += size_of(property) * element_.count;
  }
}

void PointDecoder::grow(std::size_t points) {
  cloud_.points.resize(points);
  cloud_.width = points;
  if (has(Meaning::label)) cloud_.labels.resize(points);
  if (has_colors()) cloud_.colors.resize(points);
  if (has_normals()) cloud_.normals.resize(points);
  if (has(Meaning::intensity)) cloud_.intensities.resize(points);
  if (has(Meaning::mixed)) cloud_.mixed.resize(points);
}

void PointDecoder::decode(const Property& property, const Column& column) {
  switch (property.meaning) {
    case Meaning::x:
      return decode_coordinates(property, column, 0);
    case Meaning::y:
      return decode_coordinates(property, column, 1);
    case Meaning::z:
      return decode_coordinates(property, column, 2);
    case Meaning::red:
      return decode_colors(column, 0);
    case Meaning::green:
      return decode_colors(column, 1);
    case Meaning::blue:
      return decode_colors(column, 2);
    case Meaning::packed_rgb:
      return decode_packed_colors(column);
    case Meaning::label:
      return decode_labels(property, column);
    case Meaning::normal_x:
      return decode_normals(property, column, 0);
    case Meaning::normal_y:
      return decode_normals(property, column, 1);
    case Meaning::normal_z:
      return decode_normals(property, column, 2);
    case Meaning::intensity:
      return decode_intensities(property, column);
    case Meaning::mixed:
      return decode_mixed(property, column);
    case Meaning::other:
      return;
  }
}

// Points without a position, NaN or infinite, are kept in place.
void PointDecoder::decode_coordinates(const Property& property, const Column& column, Eigen::Index axis) {
  Eigen::Vector3f* const points = cloud_.points.data();
  visit(property.type, [&]<class T>(std::type_identity<T>) {
    for_each_value<T>(column, order_, [&](std::size_t point, T value) {
      const auto coordinate = static_cast<float>(value);
      if constexpr (std::is_same_v<T, double>) {
        if (std::isfinite(value) && !std::isfinite(coordinate))
          throw InputError(place(property, point), fmt::format("{}", value),
                           "a number in the range of 32-bit floating-point numbers, inf or nan");
      }
      points[point][axis] = coordinate;
    });
  });
}

void PointDecoder::decode_colors(const Column& column, std::size_t channel) {
  Color* const colors = cloud_.colors.data();
  for_each_value<std::uint8_t>(
      column, order_, [=](std::size_t point, std::uint8_t value) { colors[point][channel] = value; });
}

void PointDecoder::decode_packed_colors(const Column& column) {
  Color* const colors = cloud_.colors.data();
  for_each_value<std::uint32_t>(
      column, order_, [=](std::size_t point, std::uint32_t value) { colors[point] = unpacked(value); });
}

void PointDecoder::decode_labels(const Property& property, const Column& column) {
  std::int32_t* const labels = cloud_.labels.data();
  visit(property.type, [&]<class T>(std::type_identity<T>) {
    if constexpr (std::is_integral_v<T>) {
      for_each_value<T>(column, order_, [&](std::size_t point, T value) {
        const auto label = as_label(value);
        if (!label)
          throw InputError(place(property, point), fmt::format("{}", value), "a label from -1 to 2147483647");
        labels[point] = *label;
      });
    }
  });
}

// A file with only some components of the normal has no normals.
void PointDecoder::decode_normals(const Property& property, const Column& column, Eigen::Index axis) {
  if (!has_normals()) return;
  Eigen::Vector3f* const normals = cloud_.normals.data();
  visit(property.type, [&]<class T>(std::type_identity<T>) {
    for_each_value<T>(column, order_,
                      [=](std::size_t point, T value) { normals[point][axis] = static_cast<float>(value); });
  });
}

void PointDecoder::decode_intensities(const Property& property, const Column& column) {
  float* const intensities = cloud_.intensities.data();
  visit(property.type, [&]<class T>(std::type_identity<T>) {
    for_each_value<T>(column, order_,
                      [=](std::size_t point, T value) { intensities[point] = static_cast<float>(value); });
  });
}

void PointDecoder::decode_mixed(const Property& property, const Column& column) {
  std::uint8_t* const mixed = cloud_.mixed.data();
  visit(property.type, [&]<class T>(std::type_identity<T>) {
    for_each_value<T>(column, order_,
                      [=](std::size_t point, T value) { mixed[point] = value != T{0} ? 1 : 0; });
  });
}

InputPlace PointDecoder::place(const Property& property, std::size_t point) const {
  if (first_line_ > 0) return {file_, first_line_ + point, property.name};
  return {file_, 0, fmt::format("{} of point {}", property.name, point + 1)};
}

}  // namespace tanglebin::cloud_format
