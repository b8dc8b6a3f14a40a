#include "tanglebin/io/ply.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <map>
#include <ostream>
#include <stdexcept>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "tanglebin/base/text.hpp"
#include "tanglebin/files/read_file.hpp"
#include "tanglebin/io/cloud_input.hpp"
#include "tanglebin/io/point_records.hpp"

namespace tanglebin {
namespace {

using namespace cloud_format;

using Words = std::vector<std::string_view>;

constexpr std::string_view vertex = "vertex";

// Names are compared with all before them.
constexpr std::size_t most_elements = 100;
constexpr std::size_t most_properties = 1000;  // of an element

struct PlyHeader {
  std::optional<Encoding> encoding;
  std::vector<Element> elements;
  std::optional<std::uint32_t> columns;  // of an organized cloud
  std::optional<std::uint32_t> rows;
};

// ---- header

// A vertex property with a meaning in a cloud, and the types it may have.
struct KnownProperty {
  std::string_view name;
  Meaning meaning;
  std::string_view types;
};
constexpr std::array<KnownProperty, 12> known_properties{{
    {"x", Meaning::x, "float or double"},
    {"y", Meaning::y, "float or double"},
    {"z", Meaning::z, "float or double"},
    {"red", Meaning::red, "uchar"},
    {"green", Meaning::green, "uchar"},
    {"blue", Meaning::blue, "uchar"},
    {"label", Meaning::label, "an integer type"},
    {"nx", Meaning::normal_x, "float or double"},
    {"ny", Meaning::normal_y, "float or double"},
    {"nz", Meaning::normal_z, "float or double"},
    {"intensity", Meaning::intensity, "a single value"},
    {"mixed", Meaning::mixed, "an integer type"},
}};

Encoding parse_format(const CloudInput& input, const Words& words) {
  static const std::map<std::string_view, Encoding> encodings{
      {"ascii", Encoding::ascii},
      {"binary_little_endian", Encoding::little_endian},
      {"binary_big_endian", Encoding::big_endian},
  };
  const std::string expected = "ascii, binary_little_endian or binary_big_endian, version 1.0";
  if (words.size() != 3) {
    throw InputError(input.place("format"), fmt::format("{} words", words.size() - 1), expected);
  }
  const auto encoding = encodings.find(words[1]);
  if (encoding == encodings.end()) throw InputError(input.place("format"), excerpt(words[1]), expected);
  if (words[2] != "1.0") throw InputError(input.place("format"), "version " + excerpt(words[2]), "1.0");
  return encoding->second;
}

Element parse_element(const CloudInput& input, const Words& words) {
  if (words.size() != 3) {
    throw InputError(input.place("element"), fmt::format("{} words", words.size() - 1), "a name and a count");
  }
  const auto count = to_number<std::size_t>(words[2]);
  if (!count) throw InputError(input.place("element " + std::string(words[1])), excerpt(words[2]), "a count");
  return {std::string(words[1]), *count, {}};
}

Scalar parse_type(const CloudInput& input, std::string_view word) {
  static const std::map<std::string_view, Scalar> types{
      {"char", Scalar::int8},      {"int8", Scalar::int8},       {"uchar", Scalar::uint8},
      {"uint8", Scalar::uint8},    {"short", Scalar::int16},     {"int16", Scalar::int16},
      {"ushort", Scalar::uint16},  {"uint16", Scalar::uint16},   {"int", Scalar::int32},
      {"int32", Scalar::int32},    {"uint", Scalar::uint32},     {"uint32", Scalar::uint32},
      {"float", Scalar::float32},  {"float32", Scalar::float32}, {"double", Scalar::float64},
      {"float64", Scalar::float64}};
  const auto type = types.find(word);
  if (type == types.end()) {
    throw InputError(input.place("property"), "type " + excerpt(word),
                     "char, uchar, short, ushort, int, uint, float or double");
  }
  return type->second;
}

Property parse_property(const CloudInput& input, const Words& words) {
  const bool list = words.size() > 1 && words[1] == "list";
  const std::size_t due = list ? 5 : 3;
  if (words.size() != due) {
    throw InputError(input.place("property"), fmt::format("{} words", words.size() - 1),
                     list ? "list, two types and a name" : "a type and a name");
  }
  Property property;
  property.name = words.back();
  property.type = parse_type(input, words[due - 2]);
  if (list) {
    property.length_type = parse_type(input, words[2]);
    if (!is_integer(*property.length_type)) {
      throw InputError(input.place(property.name), "list length of type " + excerpt(words[2]),
                       "an integer type");
    }
  }
  return property;
}

// Assigns a vertex property its meaning in a cloud, if it has one.
void recognize(const CloudInput& input, Property& property, std::string_view type) {
  const auto known = std::ranges::find(known_properties, property.name, &KnownProperty::name);
  if (known == known_properties.end()) return;
  property.meaning = known->meaning;
  if (property.length_type || !can_be(property.meaning, property.type)) {
    throw InputError(input.place(property.name), property.length_type ? "a list" : std::string(type),
                     std::string(known->types));
  }
}

void expect_fewer(const CloudInput& input, std::size_t count, std::size_t most, std::string_view what) {
  if (count >= most)
    throw InputError(input.place(), fmt::format("more than {} {}", most, what),
                     fmt::format("at most {}", most));
}

void add_element(const CloudInput& input, const Words& words, PlyHeader& header) {
  expect_fewer(input, header.elements.size(), most_elements, "elements");
  const Element element = parse_element(input, words);
  if (std::ranges::find(header.elements, element.name, &Element::name) != header.elements.end()) {
    throw InputError(input.place("element " + element.name), "given twice");
  }
  header.elements.push_back(element);
}

void add_property(const CloudInput& input, const Words& words, PlyHeader& header) {
  Property property = parse_property(input, words);
  if (header.elements.empty()) throw InputError(input.place(property.name), "property before any element");
  Element& element = header.elements.back();
  expect_fewer(input, element.properties.size(), most_properties, "properties of an element");
  if (std::ranges::find(element.properties, property.name, &Property::name) != element.properties.end()) {
    throw InputError(input.place(property.name), "property given twice in element " + element.name);
  }
  if (element.name == vertex) recognize(input, property, words[words.size() - 2]);
  element.properties.push_back(property);
}

void add_format(const CloudInput& input, const Words& words, PlyHeader& header) {
  if (header.encoding) throw InputError(input.place("format"), "given twice");
  header.encoding = parse_format(input, words);
}

// PCL's and EpicEye's mark of an organized cloud, after Stanford's range grids: "obj_info num_cols 640". Any
// other obj_info is free text.
void note_grid(const Words& words, PlyHeader& header) {
  if (words.size() != 3) return;
  if (words[1] == "num_cols") header.columns = to_number<std::uint32_t>(words[2]);
  if (words[1] == "num_rows") header.rows = to_number<std::uint32_t>(words[2]);
}

void expect_magic(CloudInput& input) {
  const auto line = input.next_line();
  if (!line) throw InputError(input.place_in_file(), "an empty file", "a PLY file");
  if (*line != "ply") throw InputError(input.place(), excerpt(*line), "ply, the first line of a PLY file");
}

void expect_property(const CloudInput& input, const Element& vertices, std::string_view name) {
  if (std::ranges::find(vertices.properties, name, &Property::name) == vertices.properties.end()) {
    throw InputError(input.place_in_file(), fmt::format("element vertex has no property {}", name));
  }
}

void check_vertices(const CloudInput& input, const PlyHeader& header) {
  const auto vertices = std::ranges::find(header.elements, vertex, &Element::name);
  if (vertices == header.elements.end()) throw InputError(input.place_in_file(), "has no element vertex");
  for (const std::string_view name : {"x", "y", "z"}) expect_property(input, *vertices, name);
  const bool has_color =
      find(*vertices, Meaning::red) || find(*vertices, Meaning::green) || find(*vertices, Meaning::blue);
  if (!has_color) return;
  for (const std::string_view name : {"red", "green", "blue"}) expect_property(input, *vertices, name);
}

void check_header(const CloudInput& input, const PlyHeader& header) {
  if (!header.encoding) throw InputError(input.place_in_file(), "has no format line");
  for (const Element& element : header.elements) {
    // Otherwise any number of them would take no data at all.
    if (element.properties.empty()) {
      throw InputError(input.place_in_file(element.name), "element without properties");
    }
  }
  check_vertices(input, header);
}

PlyHeader read_ply_header(CloudInput& input) {
  expect_magic(input);
  PlyHeader header;
  while (const auto line = input.next_line()) {
    const Words words = words_of(*line);
    const std::string_view keyword = words.empty() ? std::string_view() : words.front();
    if (keyword == "end_header") {
      check_header(input, header);
      return header;
    }
    if (keyword == "comment") continue;
    if (keyword == "obj_info") {
      note_grid(words, header);
    } else if (keyword == "format") {
      add_format(input, words, header);
    } else if (keyword == "element") {
      add_element(input, words, header);
    } else if (keyword == "property") {
      add_property(input, words, header);
    } else {
      throw InputError(input.place(), excerpt(keyword), "format, element, property, comment or end_header");
    }
  }
  throw InputError(input.place(), "the end of the file", "end_header");
}

// ---- body

PointCloud read_vertices(CloudInput& input, Encoding encoding, const Element& vertices) {
  PointDecoder decoder(input, vertices, encoding);
  decoder.reserve(input.remaining());
  read_records(input, encoding, vertices, [&](const Records& records) { decoder.add_records(records); });
  return decoder.take();
}

void skip_element(CloudInput& input, Encoding encoding, const Element& element) {
  read_records(input, encoding, element, [](const Records&) {});
}

void expect_end(CloudInput& input, Encoding encoding) {
  if (encoding == Encoding::ascii) {
    expect_no_more_lines(input);
  } else if (!input.at_end()) {
    throw InputError(input.place_in_file(), "data after the last element that the header declares");
  }
}

// Range grids say how large they are too, but have vertices for the measured places only.
void arrange(PointCloud& cloud, const PlyHeader& header) {
  if (!header.columns || !header.rows || cloud.points.empty()) return;
  if (std::size_t{*header.columns} * *header.rows != cloud.points.size()) return;
  cloud.width = *header.columns;
  cloud.height = *header.rows;
}

// ---- writing

std::string header_of(const PointCloud& cloud, std::string_view coordinates) {
  const std::string grid = cloud.height > 1 ? fmt::format("obj_info num_cols {}\nobj_info num_rows {}\n",
                                                          cloud.width, cloud.height)
                                            : "";
  std::string header = fmt::format(
      "ply\n"
      "format binary_little_endian 1.0\n"
      "comment Tanglebin: {}; label 0 bin, 1..n tubes, -1 null\n"
      "{}element vertex {}\n"
      "property float x\n"
      "property float y\n"
      "property float z\n",
      coordinates, grid, cloud.points.size());
  if (!cloud.normals.empty()) header += "property float nx\nproperty float ny\nproperty float nz\n";
  if (!cloud.colors.empty()) header += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  if (!cloud.labels.empty()) header += "property int label\n";
  if (!cloud.intensities.empty()) header += "property float intensity\n";
  if (!cloud.mixed.empty()) header += "property uchar mixed\n";
  return header + "end_header\n";
}

// Copies a value's bytes to `to`, and returns the position after them.
template <class T>
char* put(char* to, const T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  static_assert(std::endian::native == std::endian::little, "the files' byte order");
  std::memcpy(to, &value, sizeof(T));
  return to + sizeof(T);
}

char* put_vector(char* to, const Eigen::Vector3f& v) {
  return put(to, std::array{v.x(), v.y(), v.z()});
}

// Bytes per point of an optional property.
template <class T>
std::size_t size_of_one(const std::vector<T>& values) {
  return values.empty() ? 0 : sizeof(T);
}

}  // namespace

PointCloud read_ply(std::istream& in, const std::string& name) {
  CloudInput input(in, name);
  const PlyHeader header = read_ply_header(input);
  PointCloud cloud;
  for (const Element& element : header.elements) {
    if (element.name == vertex) {
      cloud = read_vertices(input, *header.encoding, element);
    } else {
      skip_element(input, *header.encoding, element);
    }
  }
  expect_end(input, *header.encoding);
  arrange(cloud, header);
  return cloud;
}

PointCloud read_ply(const std::filesystem::path& file) {
  std::ifstream stream = open_input(file);
  return read_ply(stream, file.string());
}

void write_ply(std::ostream& out, const PointCloud& cloud, std::string_view coordinates) {
  check_cloud(cloud);
  const std::string header = header_of(cloud, coordinates);
  out.write(header.data(), static_cast<std::streamsize>(header.size()));
  const std::size_t point_size = sizeof(Eigen::Vector3f) + size_of_one(cloud.normals) +
                                 size_of_one(cloud.colors) + size_of_one(cloud.labels) +
                                 size_of_one(cloud.intensities) + size_of_one(cloud.mixed);
  // A block at a time: memory that is touched for the first time costs more than the writing.
  std::array<char, 1 << 15> block;
  char* to = block.data();
  const auto flush = [&] { out.write(block.data(), std::exchange(to, block.data()) - block.data()); };
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (static_cast<std::size_t>(block.data() + block.size() - to) < point_size) flush();
    to = put_vector(to, cloud.points[i]);
    if (!cloud.normals.empty()) to = put_vector(to, cloud.normals[i]);
    if (!cloud.colors.empty()) to = put(to, cloud.colors[i]);
    if (!cloud.labels.empty()) to = put(to, cloud.labels[i]);
    if (!cloud.intensities.empty()) to = put(to, cloud.intensities[i]);
    if (!cloud.mixed.empty()) to = put(to, cloud.mixed[i]);
  }
  flush();
}

}  // namespace tanglebin
