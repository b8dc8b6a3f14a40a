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

// Internal to the room: the common ground of PLY and PCD, which both describe a point as a list of typed,
// named values.
namespace tanglebin::cloud_format {

enum class Scalar { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

std::size_t size_of(Scalar type);
bool is_integer(Scalar type);

/// What a property of a point is to a PointCloud.
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

/// Whether a property of this type can have this meaning: coordinates and normals are floating-point numbers,
/// colours uint8, packed colours 32 bits wide, labels and marks integers; anything goes for intensities and
/// `other`.
bool can_be(Meaning meaning, Scalar type);

struct Property {
  std::string name;
  Scalar type = Scalar::float32;
  Meaning meaning = Meaning::other;
  std::size_t count = 1;              ///< values a point has of it (PCD)
  std::optional<Scalar> length_type;  ///< a list (PLY): type of its length, which precedes the values
};

/// What a file holds `count` of, one after the other: PLY's elements, PCD's points.
struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;
};

const Property* find(const Element& element, Meaning meaning);

/// Bytes of a property within a record; 0 for a list, which is left out of it.
std::size_t size_of(const Property& property);
std::size_t record_size(const Element& element);

enum class Encoding { ascii, little_endian, big_endian };

/// A run of elements read: `count` records of record_size() bytes, the first being element `first`.
struct Records {
  const std::byte* bytes;
  std::size_t first;
  std::size_t count;
};

/// Reads all of an element and hands it to `consume`, run by run. In ascii, each is a line of its own, and
/// only the values that mean something are parsed. Throws InputError where there are fewer than `count`, or a
/// line has not the values that are due.
void read_records(CloudInput& input, Encoding encoding, const Element& element,
                  const std::function<void(const Records&)>& consume);

/// Throws InputError where anything but blank lines follows.
void expect_no_more_lines(CloudInput& input);

/// The values of one property of points [first_point, first_point + count), `stride` bytes apart.
struct Column {
  const std::byte* bytes;
  std::size_t stride;
  std::size_t first_point;
  std::size_t count;
};

/// Puts the values of a file into a cloud, and says where a bad one is.
class PointDecoder {
public:
  enum class Nan { rejected, kept };

  /// The points of `element`, whose data comes next in `input`.
  PointDecoder(const CloudInput& input, const Element& element, Encoding encoding, Nan nan);

  /// Makes room for the points that so many bytes of binary data can hold.
  void reserve(std::size_t bytes);

  /// Adds points that lie in memory one after the other.
  void add_records(const Records& records);

  /// Adds all points at once from planes: all values of the first property, all of the second, and so on.
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
  std::size_t first_line_;  ///< of the points in an ascii file, one a line; 0 in a binary file
  Nan nan_;
  PointCloud cloud_;
};

}  // namespace tanglebin::cloud_format
