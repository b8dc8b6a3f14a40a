#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/io/cloud_input.hpp"

// Internal to the room: common code for PLY and PCD, which both store a point as a list of typed, named
// values.
namespace tanglebin::cloud_format {

enum class Scalar { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

std::size_t size_of(Scalar type);
bool is_integer(Scalar type);

/// The role of a property in a PointCloud.
enum class Meaning {
  other,
  x,
  y,
  z,
  red,
  green,
  blue,
  packed_rgb,
  label,
  normal_x,
  normal_y,
  normal_z,
  intensity,
  mixed
};

/// True if a property of this type can have this meaning. Coordinates and normals are floating-point, colours
/// uint8, packed colours 32 bits wide, labels and marks integers. Intensities and `other` may be anything.
bool can_be(Meaning meaning, Scalar type);

struct Property {
  std::string name;
  Scalar type = Scalar::float32;
  Meaning meaning = Meaning::other;
  std::size_t count = 1;              ///< values per point (PCD)
  std::optional<Scalar> length_type;  ///< for a list (PLY): the type of its length, which precedes the values
};

/// A sequence of `count` equal records in a file: a PLY element, or the points of a PCD file.
struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;
};

const Property* find(const Element& element, Meaning meaning);

/// Bytes of a property within a record; 0 for a list, which is skipped.
std::size_t size_of(const Property& property);
std::size_t record_size(const Element& element);

enum class Encoding { ascii, little_endian, big_endian };

/// Consecutive records in memory: `count` of record_size() bytes each, starting with element `first`.
struct Records {
  const std::byte* bytes;
  std::size_t first;
  std::size_t count;
};

/// Reads a whole element and passes it to `consume`, piece by piece. In ascii files, each record is a line,
/// and only values with a meaning are parsed. Throws InputError if there are fewer than `count` records, or
/// if a line has the wrong number of values.
void read_records(CloudInput& input, Encoding encoding, const Element& element,
                  const std::function<void(const Records&)>& consume);

/// Throws InputError if anything but blank lines follows.
void expect_no_more_lines(CloudInput& input);

/// The values of one property of points [first_point, first_point + count), `stride` bytes apart.
struct Column {
  const std::byte* bytes;
  std::size_t stride;
  std::size_t first_point;
  std::size_t count;
};

/// Converts the values of a file into a cloud, and reports the position of bad values.
class PointDecoder {
public:
  /// For the points of `element`, whose data comes next in `input`.
  PointDecoder(const CloudInput& input, const Element& element, Encoding encoding);

  /// Reserves memory for as many points as this number of bytes of binary data can hold.
  void reserve(std::size_t bytes);

  /// Adds points stored one after the other.
  void add_records(const Records& records);

  /// Adds all points at once, stored as planes: all values of the first property, then all of the second, and
  /// so on.
  void add_planes(const std::byte* planes);

  PointCloud take() { return std::move(cloud_); }

private:
  bool has(Meaning meaning) const { return find(element_, meaning) != nullptr; }
  bool has_colors() const { return has(Meaning::red) || has(Meaning::packed_rgb); }
  bool has_normals() const {
    return has(Meaning::normal_x) && has(Meaning::normal_y) && has(Meaning::normal_z);
  }
  void grow(std::size_t points);
  void decode(const Property& property, const Column& column);
  void decode_coordinates(const Property& property, const Column& column, Eigen::Index axis);
  void decode_colors(const Column& column, std::size_t channel);
  void decode_packed_colors(const Column& column);
  void decode_labels(const Property& property, const Column& column);
  void decode_normals(const Property& property, const Column& column, Eigen::Index axis);
  void decode_intensities(const Property& property, const Column& column);
  void decode_mixed(const Property& property, const Column& column);
  InputPlace place(const Property& property, std::size_t point) const;

  std::string file_;
  const Element& element_;
  std::endian order_;
  std::size_t first_line_;  ///< of the points in an ascii file, which has one per line; 0 in a binary file
  PointCloud cloud_;
};

}  // namespace tanglebin::cloud_format
