#include "tanglebin/io/ply.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <stdexcept>

#include "tests/cloud/clouds.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/temporary_directory.hpp"

namespace tanglebin {
namespace {

using test::complaint;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

PointCloud read(const std::string& file) {
  std::istringstream stream(file);
  return read_ply(stream, "cloud.ply");
}

std::string complaint_about(const std::string& file) {
  return complaint([&] { read(file); });
}

std::string written(const PointCloud& cloud) {
  std::ostringstream stream;
  write_ply(stream, cloud);
  return stream.str();
}

// ---- writing

TEST(WritePly, WritesWhatTheFormatSays) {
  PointCloud cloud = small_cloud();
  cloud.points.resize(1);
  cloud.colors.resize(1);
  cloud.labels = {-1};
  cloud.width = 1;
  EXPECT_EQ(written(cloud),
            "ply\n"
            "format binary_little_endian 1.0\n"
            "comment Tanglebin: metres, world frame; label 0 bin, 1..n tubes, -1 null\n"
            "element vertex 1\n"
            "property float x\n"
            "property float y\n"
            "property float z\n"
            "property uchar red\n"
            "property uchar green\n"
            "property uchar blue\n"
            "property int label\n"
            "end_header\n" +
                bytes_of(0.25F) + bytes_of(-0.5F) + bytes_of(0.125F) + "\x80\x80\x80" +
                bytes_of(std::int32_t{-1}));
}

TEST(WritePly, LeavesOutWhatTheCloudHasNot) {
  PointCloud cloud = small_cloud();
  cloud.colors.clear();
  cloud.labels.clear();
  const PointCloud back = read(written(cloud));
  EXPECT_TRUE(same_properties(back, cloud));
  EXPECT_THAT(back.labels, IsEmpty());
  EXPECT_THAT(back.colors, IsEmpty());
}

TEST(WritePly, RefusesWhatItCouldNotReadBack) {
  PointCloud cloud = small_cloud();
  cloud.labels.pop_back();
  EXPECT_THROW(written(cloud), std::invalid_argument);
}

RC_GTEST_PROP(Ply, ComesBackAsItWas, ()) {
  PointCloud cloud = *any_cloud();
  cloud.height = cloud.width % 3 == 0 ? 3 : 1;
  cloud.width /= cloud.height;
  if (*rc::gen::arbitrary<bool>()) cloud.points[0] = Eigen::Vector3f::Constant(nan);
  const PointCloud back = read(written(cloud));
  RC_ASSERT(same_properties(back, cloud));
  RC_ASSERT(back.width == cloud.width);
  RC_ASSERT(back.height == cloud.height);
  RC_ASSERT(!back.viewpoint);
}

TEST(Ply, OfNoPointsComesBackEmpty) {
  EXPECT_THAT(read(written(PointCloud{})).points, IsEmpty());
}

TEST(Ply, OfManyRunsComesBackAsItWas) {
  PointCloud cloud;
  cloud.width = 20'000;
  for (std::size_t i = 0; i < cloud.width; ++i) {
    cloud.points.emplace_back(static_cast<float>(i), -static_cast<float>(i), 0.5F);
    cloud.labels.push_back(static_cast<std::int32_t>(i));
    cloud.colors.push_back({static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(i >> 8), 7});
  }
  EXPECT_TRUE(same_properties(read(written(cloud)), cloud));
}

// ---- reading what others write

// Writes numbers in one of PLY's three formats; types by their PLY names.
class Emitter {
public:
  explicit Emitter(std::string format) : format_(std::move(format)) {}

  void value(const std::string& type, double number) {
    if (format_ == "ascii") {
      // 17 digits give any double back.
      body_ += fmt::format("{}{:.17g}", body_.empty() || body_.back() == '\n' ? "" : " ", number);
    } else if (type == "float" || type == "float32") {
      body_ += bytes_of(static_cast<float>(number), order());
    } else if (type == "double" || type == "float64") {
      body_ += bytes_of(number, order());
    } else {
      integer(type, static_cast<std::int64_t>(number));
    }
  }

  void end_element() {
    if (format_ == "ascii") body_ += '\n';
  }

  std::string file(const std::string& elements) const {
    return "ply\nformat " + format_ + " 1.0\n" + elements + "end_header\n" + body_;
  }

private:
  std::endian order() const {
    return format_ == "binary_big_endian" ? std::endian::big : std::endian::little;
  }

  void integer(const std::string& type, std::int64_t number) {
    if (type == "char" || type == "uchar" || type == "int8" || type == "uint8") {
      body_ += bytes_of(static_cast<std::uint8_t>(number), order());
    } else if (type == "short" || type == "ushort" || type == "int16" || type == "uint16") {
      body_ += bytes_of(static_cast<std::uint16_t>(number), order());
    } else {
      body_ += bytes_of(static_cast<std::uint32_t>(number), order());
    }
  }

  std::string format_;
  std::string body_;
};

struct Property {
  std::string name;
  std::string type;
  std::function<double(std::size_t)> value;
};

// The properties of a cloud's vertices, with others between them, in any order and of any valid type.
std::vector<Property> any_properties_of(const PointCloud& cloud) {
  std::vector<Property> properties;
  for (const int axis : {0, 1, 2}) {
    properties.push_back({std::string(1, "xyz"[axis]),
                          *rc::gen::element<std::string>("float", "double", "float64"),
                          [&cloud, axis](std::size_t i) { return cloud.points[i][axis]; }});
  }
  const std::array<std::string, 3> channels{"red", "green", "blue"};
  for (std::size_t c = 0; c < 3 && !cloud.colors.empty(); ++c) {
    properties.push_back({channels[c], *rc::gen::element<std::string>("uchar", "uint8"),
                          [&cloud, c](std::size_t i) { return cloud.colors[i][c]; }});
  }
  if (!cloud.labels.empty()) {
    properties.push_back({"label", *rc::gen::element<std::string>("int", "short", "char", "int8", "int32"),
                          [&cloud](std::size_t i) { return cloud.labels[i]; }});
  }
  const int others = *rc::gen::inRange(0, 4);
  for (int other = 0; other < others; ++other) {
    properties.push_back({fmt::format("other{}", other),
                          *rc::gen::element<std::string>("uchar", "ushort", "uint", "float", "double"),
                          [](std::size_t i) { return static_cast<double>(i % 100); }});
  }
  for (std::size_t i = properties.size(); i > 1; --i) {
    std::swap(properties[i - 1], properties[*rc::gen::inRange<std::size_t>(0, i)]);
  }
  return properties;
}

RC_GTEST_PROP(ReadPly, ReadsEveryFormatTypeAndOrder, ()) {
  PointCloud cloud = *any_cloud();
  cloud.points[0].x() = *rc::gen::element(0.5F, nan, infinity, -infinity);
  const auto properties = any_properties_of(cloud);
  const bool face_first = *rc::gen::arbitrary<bool>();
  const auto list_at = *rc::gen::inRange<std::size_t>(0, 2 * properties.size());  // beyond the end: no list

  Emitter emitter(*rc::gen::element<std::string>("ascii", "binary_little_endian", "binary_big_endian"));
  const auto emit_list = [&](std::size_t length) {
    emitter.value("uchar", static_cast<double>(length));
    for (std::size_t i = 0; i < length; ++i) emitter.value("int", static_cast<double>(i));
  };
  const auto emit_faces = [&] {
    for (const std::size_t length : {3U, 0U, 4U}) {
      emit_list(length);
      emitter.end_element();
    }
  };
  const std::string face = "element face 3\nproperty list uchar int vertex_indices\n";
  std::string vertex = fmt::format("element vertex {}\n", cloud.points.size());
  for (std::size_t p = 0; p < properties.size(); ++p) {
    if (p == list_at) vertex += "property list uchar int neighbours\n";
    vertex += fmt::format("property {} {}\n", properties[p].type, properties[p].name);
  }

  if (face_first) emit_faces();
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    for (std::size_t p = 0; p < properties.size(); ++p) {
      if (p == list_at) emit_list(i % 3);
      emitter.value(properties[p].type, properties[p].value(i));
    }
    emitter.end_element();
  }
  if (!face_first) emit_faces();
  RC_ASSERT(same_properties(read(emitter.file(face_first ? face + vertex : vertex + face)), cloud));
}

// Not a seekable one: it gives a byte at a time and knows no position, as a pipe.
class Pipe : public std::streambuf {
public:
  explicit Pipe(std::string data) : data_(std::move(data)) {}

protected:
  int_type underflow() override {
    if (next_ == data_.size()) return traits_type::eof();
    char* const byte = &data_[next_++];
    setg(byte, byte, byte + 1);
    return traits_type::to_int_type(*byte);
  }

private:
  std::string data_;
  std::size_t next_ = 0;
};

TEST(ReadPly, ReadsAPipe) {
  Pipe pipe(written(small_cloud()));
  std::istream stream(&pipe);
  EXPECT_TRUE(same_properties(read_ply(stream, "-"), small_cloud()));
}

TEST(ReadPly, ReadsAFile) {
  const test::TemporaryDirectory directory;
  const auto file = directory / "cloud.ply";
  test::write_bytes(file, written(small_cloud()));
  EXPECT_TRUE(same_properties(read_ply(file), small_cloud()));
}

TEST(ReadPly, ReadsHeadersAndLinesThatEndInCarriageReturns) {
  const PointCloud text = read(
      "ply\r\nformat ascii 1.0\r\nelement vertex 1\r\nproperty float x\r\n"
      "property float y\r\nproperty float z\r\nend_header\r\n1 2 3\r\n");
  EXPECT_THAT(text.points, ElementsAre(Eigen::Vector3f(1, 2, 3)));
  // The body begins right after the line feed, whatever its first byte.
  const PointCloud binary = read(
      "ply\r\nformat binary_little_endian 1.0\r\nelement vertex 1\r\n"
      "property uchar other\r\nproperty float x\r\nproperty float y\r\n"
      "property float z\r\nend_header\r\n\n" +
      bytes_of(1.0F) + bytes_of(2.0F) + bytes_of(3.0F));
  EXPECT_THAT(binary.points, ElementsAre(Eigen::Vector3f(1, 2, 3)));
}

TEST(ReadPly, ReadsCommentsTabsBlankLinesAtTheEndAndALastLineWithoutEnd) {
  const std::string header =
      "ply\ncomment made by hand\nformat ascii 1.0\nobj_info one of a kind\ncomment\nelement vertex 2\n"
      "property  float\tx\nproperty float y\nproperty double z\nend_header\n";
  const std::vector<Eigen::Vector3f> points{{1.0F, -0.002F, 0.5F}, {0.0F, 4.0F, 5.0F}};
  EXPECT_EQ(read(header + "1 -2e-3 .5\n\t0  4\t5 \n\n  \n").points, points);
  EXPECT_EQ(read(header + "1 -2e-3 .5\n0 4 5").points, points);
}

// A header of one ascii vertex; `property` lines may be replaced.
std::string header(const std::string& vertex_lines, const std::string& format = "ascii") {
  return "ply\nformat " + format + " 1.0\nelement vertex 2\n" + vertex_lines + "end_header\n";
}

const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
TEST(ReadPly, KeepsPointsWithoutAPositionInPlace) {
  const PointCloud text = read(header(xyz) + "nan NaN -nan\n1 -inf Infinity\n");
  ASSERT_EQ(text.points.size(), 2U);
  EXPECT_TRUE(same_point(text.points[0], Eigen::Vector3f::Constant(nan)));
  EXPECT_TRUE(same_point(text.points[1], Eigen::Vector3f(1, -infinity, infinity)));
}

TEST(ReadPly, TakesAGridForAnOrganizedCloud) {
  const auto grid = [](const std::string& columns, const std::string& rows) {
    const PointCloud cloud = read("ply\nformat ascii 1.0\nobj_info scanned by hand\nobj_info num_cols " +
                                  columns + "\nobj_info num_rows " + rows + "\nelement vertex 6\n" + xyz +
                                  "end_header\n" + "1 2 3\n1 2 3\n1 2 3\n1 2 3\n1 2 3\n1 2 3\n");
    return std::pair(cloud.width, cloud.height);
  };
  using Size = std::pair<std::size_t, std::size_t>;
  EXPECT_EQ(grid("3", "2"), Size(3, 2));
  EXPECT_EQ(grid("1", "6"), Size(1, 6));
  EXPECT_EQ(grid("4", "2"), Size(6, 1)) << "with places where nothing was measured, and no vertex is";
  EXPECT_EQ(grid("3.0", "2"), Size(6, 1));
  EXPECT_EQ(grid("4294967295", "4294967295"), Size(6, 1));
}

TEST(ReadPly, TakesPclsInvalidUnsignedLabelForNull) {
  const std::string header =
      "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty float x\n"
      "property float y\nproperty float z\nproperty uint label\nend_header\n";
  EXPECT_THAT(read(header + std::string(12, '\0') + "\xff\xff\xff\xff").labels, ElementsAre(-1));
}

// ---- bad input

const std::string label = "property int label\n";

TEST(ReadPly, SaysWhatIsWrongWithAFile) {
  EXPECT_EQ(complaint([] { read_ply(std::filesystem::path("no/such.ply")); }),
            "no/such.ply: cannot be opened: No such file or directory");
  EXPECT_EQ(complaint([] { read_ply(std::filesystem::path("/")); }), "/: is a directory");
  EXPECT_EQ(complaint_about(""), "cloud.ply: found an empty file, expected a PLY file");
  EXPECT_EQ(complaint_about("PLY\n"), "cloud.ply:1: found 'PLY', expected ply, the first line of a PLY file");
  EXPECT_EQ(complaint_about("\x89PNG\r\n"),
            "cloud.ply:1: found '\\x89PNG', expected ply, the first line of a PLY file");
  EXPECT_EQ(complaint_about(std::string(50, 'a')),
            "cloud.ply:1: found 'aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa…', "
            "expected ply, the first line of a PLY file");
  EXPECT_EQ(complaint_about(std::string(1 << 20, '\0')), "cloud.ply:1: line longer than 65535 bytes");
  EXPECT_EQ(complaint_about("ply\n" + std::string(1 << 20, ' ')),
            "cloud.ply:2: line longer than 65535 bytes");
}

TEST(ReadPly, SaysWhatIsWrongWithAHeader) {
  EXPECT_EQ(complaint_about("ply\nformat ascii 1.0\n"),
            "cloud.ply:2: found the end of the file, expected end_header");
  EXPECT_EQ(complaint_about("ply\n\n"),
            "cloud.ply:2: found '', expected format, element, property, comment or end_header");
  EXPECT_EQ(complaint_about("ply\nvertices 3\n"),
            "cloud.ply:2: found 'vertices', expected format, element, property, comment or end_header");
  EXPECT_EQ(complaint_about("ply\nelement vertex 0\n" + xyz + "end_header\n"),
            "cloud.ply: has no format line");
  EXPECT_EQ(complaint_about("ply\nformat ascii 1.0\nend_header\n"), "cloud.ply: has no element vertex");
}

TEST(ReadPly, SaysWhatIsWrongWithAFormatLine) {
  EXPECT_EQ(complaint_about("ply\nformat ascii\n"),
            "cloud.ply:2: format: found 1 words, expected ascii, binary_little_endian or binary_big_endian, "
            "version 1.0");
  EXPECT_EQ(complaint_about("ply\nformat binary 1.0\n"),
            "cloud.ply:2: format: found 'binary', expected ascii, binary_little_endian or binary_big_endian, "
            "version 1.0");
  EXPECT_EQ(complaint_about("ply\nformat ascii 2.0\n"),
            "cloud.ply:2: format: found version '2.0', expected 1.0");
  EXPECT_EQ(complaint_about("ply\nformat ascii 1.0\nformat ascii 1.0\n"), "cloud.ply:3: format: given twice");
}

TEST(ReadPly, SaysWhatIsWrongWithAnElementLine) {
  EXPECT_EQ(complaint_about("ply\nelement vertex\n"),
            "cloud.ply:2: element: found 1 words, expected a name and a count");
  EXPECT_EQ(complaint_about("ply\nelement vertex -1\n"),
            "cloud.ply:2: element vertex: found '-1', expected a count");
  EXPECT_EQ(complaint_about("ply\nelement vertex 99999999999999999999\n"),
            "cloud.ply:2: element vertex: found '99999999999999999999', expected a count");
  EXPECT_EQ(complaint_about("ply\nelement vertex 1\nelement vertex 1\n"),
            "cloud.ply:3: element vertex: given twice");
  EXPECT_EQ(complaint_about("ply\nformat ascii 1.0\nelement rock 9999999999\nelement vertex 0\n" + xyz +
                            "end_header\n"),
            "cloud.ply: rock: element without properties");
}

TEST(ReadPly, SaysWhatIsWrongWithAPropertyLine) {
  EXPECT_EQ(complaint_about("ply\nproperty float x\n"), "cloud.ply:2: x: property before any element");
  EXPECT_EQ(complaint_about("ply\nelement vertex 1\nproperty float\n"),
            "cloud.ply:3: property: found 1 words, expected a type and a name");
  EXPECT_EQ(complaint_about("ply\nelement vertex 1\nproperty list uchar int\n"),
            "cloud.ply:3: property: found 3 words, expected list, two types and a name");
  EXPECT_EQ(
      complaint_about("ply\nelement vertex 1\nproperty real x\n"),
      "cloud.ply:3: property: found type 'real', expected char, uchar, short, ushort, int, uint, float or "
      "double");
  EXPECT_EQ(complaint_about("ply\nelement vertex 1\nproperty list float int n\n"),
            "cloud.ply:3: n: found list length of type 'float', expected an integer type");
  EXPECT_EQ(complaint_about("ply\nelement vertex 1\nproperty float x\nproperty float x\n"),
            "cloud.ply:4: x: property given twice in element vertex");
}

TEST(ReadPly, SaysWhichPropertyIsMissingOrOfTheWrongType) {
  EXPECT_EQ(complaint_about(header("property float x\nproperty float z\n")),
            "cloud.ply: element vertex has no property y");
  EXPECT_EQ(complaint_about(header(xyz + "property uchar red\nproperty uchar blue\n")),
            "cloud.ply: element vertex has no property green");
  EXPECT_EQ(complaint_about(header("property int x\n")),
            "cloud.ply:4: x: found int, expected float or double");
  EXPECT_EQ(complaint_about(header("property float red\n")), "cloud.ply:4: red: found float, expected uchar");
  EXPECT_EQ(complaint_about(header("property double label\n")),
            "cloud.ply:4: label: found double, expected an integer type");
  EXPECT_EQ(complaint_about(header("property list uchar int label\n")),
            "cloud.ply:4: label: found a list, expected an integer type");
}

TEST(ReadPly, SaysWhatIsWrongWithALineOfText) {
  EXPECT_EQ(complaint_about(header(xyz) + "1 2 3\n1 2\n"), "cloud.ply:9: found 2 values, expected 3");
  EXPECT_EQ(complaint_about(header(xyz) + "1 2 3\n1 2 3 4\n"), "cloud.ply:9: found 4 values, expected 3");
  EXPECT_EQ(complaint_about(header(xyz) + "\n1 2 3\n1 2 3\n"), "cloud.ply:8: found 0 values, expected 3");
  EXPECT_EQ(complaint_about(header(xyz) + "1 2 3\n1 2,5 3\n"),
            "cloud.ply:9: y: found '2,5', expected a 32-bit floating-point number");
  EXPECT_EQ(complaint_about(header(xyz) + "1 2 1e39\n"),
            "cloud.ply:8: z: found '1e39', expected a 32-bit floating-point number");
  EXPECT_EQ(
      complaint_about(header("property double x\nproperty float y\nproperty float z\n") + "1e400 2 3\n"),
      "cloud.ply:8: x: found '1e400', expected a 64-bit floating-point number");
  EXPECT_EQ(complaint_about(header(xyz + "property uchar red\nproperty uchar green\nproperty uchar blue\n") +
                            "1 2 3 255 256 0\n"),
            "cloud.ply:11: green: found '256', expected an integer from 0 to 255");
  EXPECT_EQ(complaint_about(header(xyz + label) + "1 2 3 4.0\n"),
            "cloud.ply:9: label: found '4.0', expected an integer from -2147483648 to 2147483647");
  EXPECT_EQ(complaint_about(header(xyz + label) + "1 2 3 2147483648\n"),
            "cloud.ply:9: label: found '2147483648', expected an integer from -2147483648 to 2147483647");
  EXPECT_EQ(complaint_about(header(xyz + "property list uchar int n\n") + "1 2 3 2 7\n"),
            "cloud.ply:9: found 5 values, expected 6");
  EXPECT_EQ(complaint_about(header(xyz + "property list uchar int n\n") + "1 2 3\n"),
            "cloud.ply:9: found 3 values, expected 4");
  EXPECT_EQ(complaint_about(header(xyz + "property list uchar int n\n") + "1 2 3 -1\n"),
            "cloud.ply:9: n: found '-1', expected an integer from 0 to 4294967295");
}

TEST(ReadPly, SaysWhichCoordinateIsTooLarge) {
  const std::string x_in_double = "property double x\nproperty float y\nproperty float z\n";
  EXPECT_EQ(complaint_about(header(x_in_double, "binary_big_endian") + bytes_of(1e300, std::endian::big) +
                            std::string(24, '\0')),
            "cloud.ply: x of point 1: found 1e+300, expected a number in the range of 32-bit floating-point "
            "numbers, inf or nan");
  EXPECT_EQ(complaint_about(header(x_in_double) + "1 2 3\n-1e39 2 3\n"),
            "cloud.ply:9: x: found -1e+39, expected a number in the range of 32-bit floating-point numbers, "
            "inf or nan");
}

TEST(ReadPly, SaysWhichLabelIsNone) {
  EXPECT_EQ(complaint_about(header(xyz + label) + "1 2 3 -1\n1 2 3 -2\n"),
            "cloud.ply:10: label: found -2, expected a label from -1 to 2147483647");
  EXPECT_EQ(complaint_about(header(xyz + "property uint label\n") + "1 2 3 4\n1 2 3 3000000000\n"),
            "cloud.ply:10: label: found 3000000000, expected a label from -1 to 2147483647");
}

TEST(ReadPly, SaysHowManyPointsAreThere) {
  EXPECT_EQ(complaint_about(header(xyz) + "1 2 3\n"),
            "cloud.ply: vertex: found 1 before the end of the file, expected 2");
  EXPECT_EQ(complaint_about(header(xyz, "binary_little_endian") + std::string(23, '\0')),
            "cloud.ply: vertex: found 1 before the end of the file, expected 2");
  // Enough for the run that is read at once and a bit.
  EXPECT_EQ(complaint_about("ply\nformat binary_little_endian 1.0\nelement vertex 18446744073709551615\n" +
                            xyz + "end_header\n" + std::string(12 * 10'000 + 5, '\0')),
            "cloud.ply: vertex: found 10000 before the end of the file, expected 18446744073709551615");
  const std::string face = "element face 2\nproperty list int int vertex_indices\n";
  EXPECT_EQ(complaint_about(header(xyz + face) + "1 2 3\n1 2 3\n3 0 1 2\n"),
            "cloud.ply: face: found 1 before the end of the file, expected 2");
  EXPECT_EQ(complaint_about(header(xyz + face, "binary_little_endian") + std::string(24, '\0') +
                            bytes_of(std::int32_t{2'000'000'000})),
            "cloud.ply: face: found 0 before the end of the file, expected 2");
  EXPECT_EQ(complaint_about(header(xyz + face, "binary_little_endian") + std::string(24, '\0') +
                            bytes_of(std::int32_t{-7})),
            "cloud.ply: vertex_indices: found a list of length -7, expected 0 or more");
}

TEST(ReadPly, SaysWhatComesAfterTheEnd) {
  EXPECT_EQ(complaint_about(header(xyz) + "1 2 3\n1 2 3\n\n1 2 3\n"),
            "cloud.ply:11: found '1 2 3', expected the end of the file");
  EXPECT_EQ(complaint_about(header(xyz, "binary_little_endian") + std::string(25, '\0')),
            "cloud.ply: data after the last element that the header declares");
}

TEST(ReadPly, ComplainsOfAFileCutAnywhere) {
  const std::string text =
      header(xyz + label + "element face 1\nproperty list uchar int n\n") + "1 2 3 4\n5 6 7 8\n2 10 11\n";
  const std::string last_number = "1\n";  // without it "2 10 1" is a face too
  for (const std::string& whole :
       {written(small_cloud()), text.substr(0, text.size() - last_number.size())}) {
    for (std::size_t size = 0; size < whole.size(); ++size) {
      EXPECT_NE(complaint_about(whole.substr(0, size)), "none") << size << " bytes";
    }
  }
}

TEST(Ply, KeepsNormalsIntensitiesAndMixedPoints) {
  const PointCloud cloud = cloud_of_a_sensor();
  std::stringstream file;
  write_ply(file, cloud);
  const PointCloud read = read_ply(file, "cloud");
  expect_same_sensor_properties(read, cloud);
}

TEST(ReadPly, BoundsElementsAndTheirProperties) {
  const auto properties = [](int count) {
    std::string lines;
    for (int i = 0; i < count; ++i) lines += "property float p" + std::to_string(i) + "\n";
    return lines;
  };
  const auto elements = [](int count) {
    std::string lines;
    for (int i = 0; i < count; ++i) lines += "element e" + std::to_string(i) + " 0\nproperty char p\n";
    return lines;
  };
  EXPECT_THAT(complaint_about(header(xyz + properties(997))), Not(HasSubstr("more than")));
  EXPECT_EQ(complaint_about(header(xyz + properties(998))),
            "cloud.ply:1004: found more than 1000 properties of an element, expected at most 1000");
  EXPECT_THAT(complaint_about(header(xyz + elements(99))), Not(HasSubstr("more than")));
  EXPECT_EQ(complaint_about(header(xyz + elements(100))),
            "cloud.ply:205: found more than 100 elements, expected at most 100");
}

}  // namespace
}  // namespace tanglebin
