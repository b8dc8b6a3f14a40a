#include "tanglebin/io/pcd.hpp"

#include <fmt/format.h>
#include <liblzf/lzf.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <ostream>
#include <set>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "tanglebin/base/text.hpp"
#include "tanglebin/files/read_file.hpp"
#include "tanglebin/io/cloud_input.hpp"
#include "tanglebin/io/point_records.hpp"

namespace tanglebin {
namespace {

using namespace cloud_format;

static_assert(std::endian::native == std::endian::little, "the files' byte order");

constexpr std::size_t largest_point = std::size_t{1}
                                      << 20;  // bytes; a header alone must not be able to claim memory

constexpr double quaternion_tolerance = 1e-3;  // files round quaternions to as few as four digits

// An LZF match takes at least two bytes for eight, or three for 264, so data grows by at most a factor of 88.
constexpr std::uint64_t most_lzf_expansion = 88;

// ---- header: "KEYWORD word word ...", DATA last

enum class Body { ascii, binary, binary_compressed };

struct Entry {
  std::size_t line = 0;
  std::vector<std::string> words;
};

struct PcdHeader {
  Element points;
  std::size_t width = 0;
  std::size_t height = 0;
  std::optional<Eigen::Isometry3d> viewpoint;
  Body body = Body::ascii;
};

// The entries of a header; knows the file's name for errors.
class Entries {
public:
  explicit Entries(std::string file) : file_(std::move(file)) {}

  void add(const CloudInput& input, const std::vector<std::string_view>& words) {
    constexpr std::array<std::string_view, 10> keywords{"VERSION", "FIELDS", "SIZE",      "TYPE",   "COUNT",
                                                        "WIDTH",   "HEIGHT", "VIEWPOINT", "POINTS", "DATA"};
    const std::string keyword(words.front());
    if (std::ranges::find(keywords, keyword) == keywords.end()) {
      expect_no_toml(input, words);
      throw InputError(input.place(), excerpt(keyword), fmt::format("one of {}", fmt::join(keywords, ", ")));
    }
    if (has(keyword)) throw InputError(input.place(keyword), "given twice");
    entries_[keyword] = {input.line(), {words.begin() + 1, words.end()}};
  }

  // Recipes and scene files begin with # too.
  void expect_no_toml(const CloudInput& input, const std::vector<std::string_view>& words) const {
    const bool is_table = words.front().starts_with('[');
    const bool is_key = words.size() > 1 && words[1].starts_with('=');
    if (entries_.empty() && (is_table || is_key))
      throw InputError(input.place(), "TOML, as in a recipe or a scene file", "a cloud: a PLY or PCD file");
  }

  bool has(const std::string& keyword) const { return entries_.contains(keyword); }

  const std::vector<std::string>& words(const std::string& keyword) const {
    const auto entry = entries_.find(keyword);
    if (entry == entries_.end()) throw InputError({file_, 0, ""}, "header has no " + keyword);
    return entry->second.words;
  }

  // The words of an entry, which must have this number of them.
  const std::vector<std::string>& words(const std::string& keyword, std::size_t count) const {
    const auto& found = words(keyword);
    if (found.size() != count) {
      throw InputError(place(keyword), fmt::format("{} values", found.size()), std::to_string(count));
    }
    return found;
  }

  std::size_t number(const std::string& keyword) const { return number(keyword, words(keyword, 1).front()); }

  std::size_t number(const std::string& keyword, const std::string& word) const {
    const auto value = to_number<std::uint32_t>(word);
    if (!value) throw InputError(place(keyword), excerpt(word), "an integer from 0 to 4294967295");
    return *value;
  }

  InputPlace place(const std::string& keyword) const { return {file_, entries_.at(keyword).line, keyword}; }

private:
  std::string file_;
  std::map<std::string, Entry> entries_;
};

Entries read_entries(CloudInput& input) {
  Entries entries(input.file());
  while (const auto line = input.next_line()) {
    const auto words = words_of(*line);
    if (words.empty() || words.front().starts_with('#')) continue;
    entries.add(input, words);
    if (words.front() == "DATA") return entries;
  }
  if (input.line() == 0) throw InputError(input.place_in_file(), "an empty file", "a PCD file");
  throw InputError(input.place(), "the end of the file", "DATA");
}

void check_version(const Entries& entries) {
  const std::string& version = entries.words("VERSION", 1).front();
  for (const std::string_view known : {"0.7", ".7", "0.6", ".6"}) {
    if (version == known) return;
  }
  throw InputError(entries.place("VERSION"), excerpt(version), "0.7 or 0.6");
}

// None if there is no such type.
std::optional<Scalar> to_scalar(std::string_view kind_and_size) {
  static const std::map<std::string_view, Scalar> types{
      {"I 1", Scalar::int8},    {"I 2", Scalar::int16},  {"I 4", Scalar::int32},  {"I 8", Scalar::int64},
      {"U 1", Scalar::uint8},   {"U 2", Scalar::uint16}, {"U 4", Scalar::uint32}, {"U 8", Scalar::uint64},
      {"F 4", Scalar::float32}, {"F 8", Scalar::float64}};
  const auto type = types.find(kind_and_size);
  return type == types.end() ? std::nullopt : std::optional(type->second);
}

// Assigns a field its meaning in a cloud, if it has one.
void recognize(Property& field, const std::string& type, const InputPlace& place) {
  struct Known {
    Meaning meaning;
    std::string types;
  };
  static const std::map<std::string_view, Known> known_fields{
      {"x", {Meaning::x, "F 4 or F 8"}},
      {"y", {Meaning::y, "F 4 or F 8"}},
      {"z", {Meaning::z, "F 4 or F 8"}},
      {"rgb", {Meaning::packed_rgb, "F 4 or U 4"}},
      {"rgba", {Meaning::packed_rgb, "F 4 or U 4"}},
      {"label", {Meaning::label, "I or U"}},
      {"normal_x", {Meaning::normal_x, "F 4 or F 8"}},
      {"normal_y", {Meaning::normal_y, "F 4 or F 8"}},
      {"normal_z", {Meaning::normal_z, "F 4 or F 8"}},
      {"intensity", {Meaning::intensity, "any"}},
      {"mixed", {Meaning::mixed, "I or U"}},
  };
  const auto known = known_fields.find(field.name);
  if (known == known_fields.end()) return;
  field.meaning = known->second.meaning;
  if (!can_be(field.meaning, field.type)) throw InputError(place, "type " + type, known->second.types);
  if (field.count != 1) throw InputError(place, fmt::format("COUNT {}", field.count), "1");
}

std::vector<Property> read_fields(const Entries& entries) {
  const auto& names = entries.words("FIELDS");
  const auto& sizes = entries.words("SIZE", names.size());
  const auto& kinds = entries.words("TYPE", names.size());
  std::vector<Property> fields;
  for (std::size_t i = 0; i < names.size(); ++i) {
    Property field;
    field.name = names[i];
    if (entries.has("COUNT")) field.count = entries.number("COUNT", entries.words("COUNT", names.size())[i]);
    if (field.count == 0) throw InputError(entries.place("COUNT"), "0", "1 or more");

    InputPlace place = entries.place("TYPE");
    place.field = field.name;
    const std::string type_name = kinds[i] + " " + sizes[i];
    const auto type = to_scalar(type_name);
    if (!type)
      throw InputError(place, "type " + excerpt(type_name), "F of 4 or 8 bytes, I or U of 1, 2, 4 or 8");
    field.type = *type;
    recognize(field, type_name, place);
    fields.push_back(field);
  }
  return fields;
}

void check_fields(const Entries& entries, const Element& points) {
  std::set<std::string_view> names;
  for (const Property& field : points.properties) {
    const bool padding = field.name == "_";
    if (!padding && !names.insert(field.name).second) {
      throw InputError(entries.place("FIELDS"), "field " + excerpt(field.name) + " given twice");
    }
  }
  for (const std::string_view name : {"x", "y", "z"}) {
    if (!names.contains(name)) throw InputError(entries.place("FIELDS"), fmt::format("no field {}", name));
  }
  if (names.contains("rgb") && names.contains("rgba")) {
    throw InputError(entries.place("FIELDS"), "both rgb and rgba", "one of them");
  }
  const std::size_t size = record_size(points);
  if (size > largest_point) {
    throw InputError(entries.place("FIELDS"), fmt::format("{} bytes a point", size),
                     fmt::format("at most {}", largest_point));
  }
}

// The sensor's position, and its orientation as a quaternion w x y z. PCL writes the identity for an unknown
// pose, so that means unknown.
std::optional<Eigen::Isometry3d> read_viewpoint(const Entries& entries) {
  if (!entries.has("VIEWPOINT")) return std::nullopt;
  std::array<double, 7> values{};
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::string& word = entries.words("VIEWPOINT", values.size())[i];
    const auto value = to_number<double>(word);
    if (!value || !std::isfinite(*value)) {
      throw InputError(entries.place("VIEWPOINT"), excerpt(word), "a finite number");
    }
    values[i] = *value;
  }
  const auto [x, y, z, qw, qx, qy, qz] = values;
  const Eigen::Quaterniond orientation(qw, qx, qy, qz);
  if (std::abs(orientation.norm() - 1.0) > quaternion_tolerance) {
    throw InputError(entries.place("VIEWPOINT"), fmt::format("a quaternion of length {}", orientation.norm()),
                     "1");
  }
  Eigen::Isometry3d viewpoint = Eigen::Isometry3d::Identity();
  viewpoint.translate(Eigen::Vector3d(x, y, z)).rotate(orientation.normalized());
  if (viewpoint.matrix() == Eigen::Matrix4d::Identity()) return std::nullopt;
  return viewpoint;
}

Body read_body_kind(const Entries& entries) {
  const std::string& word = entries.words("DATA", 1).front();
  if (word == "ascii") return Body::ascii;
  if (word == "binary") return Body::binary;
  if (word == "binary_compressed") return Body::binary_compressed;
  throw InputError(entries.place("DATA"), excerpt(word), "ascii, binary or binary_compressed");
}

PcdHeader read_pcd_header(CloudInput& input) {
  const Entries entries = read_entries(input);
  check_version(entries);
  PcdHeader header;
  header.width = entries.number("WIDTH");
  header.height = entries.number("HEIGHT");
  header.points = {"POINTS", header.width * header.height, read_fields(entries)};
  check_fields(entries, header.points);
  if (entries.has("POINTS") && entries.number("POINTS") != header.points.count) {
    throw InputError(entries.place("POINTS"), std::to_string(entries.number("POINTS")),
                     fmt::format("WIDTH x HEIGHT = {}", header.points.count));
  }
  header.viewpoint = read_viewpoint(entries);
  header.body = read_body_kind(entries);
  return header;
}

// ---- body

// Reads piece by piece, so that a header alone cannot claim memory.
std::vector<std::byte> read_bytes(CloudInput& input, std::size_t size) {
  constexpr std::size_t piece = std::size_t{1} << 20;
  std::vector<std::byte> bytes;
  while (bytes.size() < size) {
    const std::size_t begin = bytes.size();
    const std::size_t wanted = std::min(piece, size - begin);
    bytes.resize(begin + wanted);
    const std::size_t count = input.read(bytes.data() + begin, wanted);
    if (count < wanted) {
      throw InputError(input.place_in_file("DATA"),
                       fmt::format("{} bytes before the end of the file", begin + count),
                       std::to_string(size));
    }
  }
  return bytes;
}

// PCL's layout: the sizes before and after decompression, then LZF data that decompresses to one plane per
// field.
void read_compressed(CloudInput& input, const Element& points, PointDecoder& decoder) {
  const InputPlace place = input.place_in_file("DATA");
  std::array<std::uint32_t, 2> sizes{};
  std::memcpy(sizes.data(), read_bytes(input, sizeof(sizes)).data(), sizeof(sizes));
  const auto [packed_size, size] = sizes;
  // This cannot overflow: points have at most 2^20 bytes, and the division gives the number of points.
  if (size % record_size(points) != 0 || size / record_size(points) != points.count) {
    throw InputError(place, fmt::format("an uncompressed size of {} bytes", size),
                     fmt::format("{} points of {} bytes", points.count, record_size(points)));
  }
  if (size > most_lzf_expansion * packed_size) {
    throw InputError(place, fmt::format("a compressed size of {} bytes", packed_size),
                     fmt::format("at least {}", (size + most_lzf_expansion - 1) / most_lzf_expansion));
  }
  const std::vector<std::byte> packed = read_bytes(input, packed_size);
  std::vector<std::byte> planes(size);
  if (size > 0 && lzf_decompress(packed.data(), packed_size, planes.data(), size) != size) {
    throw InputError(place, "compressed data is damaged");
  }
  decoder.add_planes(planes.data());
}

// One of PCL's writers maps whole pages to the file and leaves zeros at the end of the last one.
void expect_padding(CloudInput& input) {
  constexpr std::size_t largest_page = std::size_t{1} << 16;  // arm64
  std::vector<std::byte> padding(largest_page + 1);
  padding.resize(input.read(padding.data(), padding.size()));
  const auto zeros = static_cast<std::size_t>(std::ranges::count(padding, std::byte{0}));
  if (padding.size() > largest_page || zeros < padding.size()) {
    throw InputError(input.place_in_file(), "data after the last point that the header declares");
  }
}

PointCloud read_points(CloudInput& input, const PcdHeader& header) {
  const Encoding encoding = header.body == Body::ascii ? Encoding::ascii : Encoding::little_endian;
  PointDecoder decoder(input, header.points, encoding);
  if (header.body == Body::binary_compressed) {
    read_compressed(input, header.points, decoder);
  } else {
    decoder.reserve(input.remaining());
    read_records(input, encoding, header.points,
                 [&](const Records& records) { decoder.add_records(records); });
  }
  if (header.body == Body::ascii) {
    expect_no_more_lines(input);
  } else {
    expect_padding(input);
  }
  return decoder.take();
}

// ---- writing

std::string viewpoint_of(const PointCloud& cloud) {
  const Eigen::Isometry3d pose = cloud.viewpoint.value_or(Eigen::Isometry3d::Identity());
  const Eigen::Vector3d p = pose.translation();
  const Eigen::Quaterniond q(pose.linear());
  return fmt::format("{} {} {} {} {} {} {}", p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z());
}

// One or several optional fields: names, sizes, types and counts.
struct FieldText {
  bool there;
  std::string_view names, sizes, types, counts;
};

std::string header_of(const PointCloud& cloud) {
  const std::array<FieldText, 6> fields{{
      {true, "x y z", "4 4 4", "F F F", "1 1 1"},
      {!cloud.colors.empty(), " rgb", " 4", " F", " 1"},
      {!cloud.labels.empty(), " label", " 4", " U", " 1"},
      {!cloud.normals.empty(), " normal_x normal_y normal_z", " 4 4 4", " F F F", " 1 1 1"},
      {!cloud.intensities.empty(), " intensity", " 4", " F", " 1"},
      {!cloud.mixed.empty(), " mixed", " 1", " U", " 1"},
  }};
  const auto line = [&](std::string_view keyword, std::string_view FieldText::*part) {
    std::string text = std::string(keyword) + ' ';
    for (const FieldText& field : fields) text += field.there ? field.*part : std::string_view();
    return text + '\n';
  };
  return "# .PCD v0.7 - Point Cloud Data file format\n"
         "VERSION 0.7\n" +
         line("FIELDS", &FieldText::names) + line("SIZE", &FieldText::sizes) +
         line("TYPE", &FieldText::types) + line("COUNT", &FieldText::counts) +
         fmt::format("WIDTH {}\nHEIGHT {}\nVIEWPOINT {}\nPOINTS {}\nDATA binary_compressed\n", cloud.width,
                     cloud.height, viewpoint_of(cloud), cloud.points.size());
}

template <class T>
void append(std::vector<std::byte>& bytes, const T& value) {
  const auto raw = std::bit_cast<std::array<std::byte, sizeof(T)>>(value);
  bytes.insert(bytes.end(), raw.begin(), raw.end());
}

std::vector<std::byte> planes_of(const PointCloud& cloud) {
  std::vector<std::byte> planes;
  planes.reserve(cloud.points.size() * (sizeof(Eigen::Vector3f) + 2 * sizeof(std::uint32_t)));
  const auto append_vectors = [&](const std::vector<Eigen::Vector3f>& vectors) {
    for (const Eigen::Index axis : {0, 1, 2}) {
      for (const Eigen::Vector3f& vector : vectors) append(planes, vector[axis]);
    }
  };
  append_vectors(cloud.points);
  for (const Color& color : cloud.colors)
    append(planes, std::array<std::uint8_t, 4>{color[2], color[1], color[0], 0});
  for (const std::int32_t label : cloud.labels) append(planes, label);
  append_vectors(cloud.normals);
  for (const float intensity : cloud.intensities) append(planes, intensity);
  for (const std::uint8_t mixed : cloud.mixed) append(planes, mixed);
  return planes;
}

// Bytes that do not compress take one extra byte per 32, so this buffer is never too small. liblzf leaves its
// hash table uninitialized, but that does not affect the result: every three earlier bytes are in the table,
// so a stale entry never stands for an earlier occurrence of the same three.
std::vector<std::byte> compressed(const std::vector<std::byte>& bytes) {
  const std::size_t capacity = bytes.size() + bytes.size() / 16 + 64;
  if (capacity > std::numeric_limits<std::uint32_t>::max()) {
    throw std::length_error("write_pcd: binary_compressed data must be smaller than 4 GiB");
  }
  std::vector<std::byte> packed(capacity);
  const unsigned size = lzf_compress(bytes.data(), static_cast<unsigned>(bytes.size()), packed.data(),
                                     static_cast<unsigned>(capacity));
  assert(size > 0 || bytes.empty());
  packed.resize(size);
  return packed;
}

}  // namespace

PointCloud read_pcd(std::istream& in, const std::string& name) {
  CloudInput input(in, name);
  const PcdHeader header = read_pcd_header(input);
  PointCloud cloud = read_points(input, header);
  cloud.width = header.width;
  cloud.height = header.height;
  cloud.viewpoint = header.viewpoint;
  return cloud;
}

PointCloud read_pcd(const std::filesystem::path& file) {
  std::ifstream stream = open_input(file);
  return read_pcd(stream, file.string());
}

void write_pcd(std::ostream& out, const PointCloud& cloud) {
  check_cloud(cloud);
  const std::vector<std::byte> planes = planes_of(cloud);
  const std::vector<std::byte> packed = compressed(planes);
  const std::array<std::uint32_t, 2> sizes{static_cast<std::uint32_t>(packed.size()),
                                           static_cast<std::uint32_t>(planes.size())};
  const std::string header = header_of(cloud);
  const auto write = [&](const void* data, std::size_t size) {
    out.write(static_cast<const char*>(data), static_cast<std::streamsize>(size));
  };
  write(header.data(), header.size());
  write(sizes.data(), sizeof(sizes));
  write(packed.data(), packed.size());
}

}  // namespace tanglebin
