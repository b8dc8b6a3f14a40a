#include "tanglebin/io/pcd.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <liblzf/lzf.h>
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
using testing::IsEmpty;

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

PointCloud read(const std::string& file) {
  std::istringstream stream(file);
  return read_pcd(stream, "cloud.pcd");
}

std::string complaint_about(const std::string& file) {
  return complaint([&] { read(file); });
}

std::string written(const PointCloud& cloud) {
  std::ostringstream stream;
  write_pcd(stream, cloud);
  return stream.str();
}

std::string lzf(const std::string& bytes) {
  std::string packed(bytes.size() * 2 + 64, '\0');
  packed.resize(lzf_compress(bytes.data(), static_cast<unsigned>(bytes.size()), packed.data(),
                             static_cast<unsigned>(packed.size())));
  return packed;
}

std::string sizes(std::size_t packed, std::size_t unpacked) {
  return bytes_of(static_cast<std::uint32_t>(packed)) + bytes_of(static_cast<std::uint32_t>(unpacked));
}

// ---- writing

TEST(WritePcd, WritesWhatPclReads) {
  PointCloud cloud = small_cloud();
  cloud.viewpoint = Eigen::Translation3d(0.5, 0.0, 2.0) * Eigen::Quaterniond(0.0, 1.0, 0.0, 0.0);
  const std::string file = written(cloud);
  const std::string header =
      "# .PCD v0.7 - Point Cloud Data file format\n"
      "VERSION 0.7\n"
      "FIELDS x y z rgb label\n"
      "SIZE 4 4 4 4 4\n"
      "TYPE F F F F U\n"
      "COUNT 1 1 1 1 1\n"
      "WIDTH 2\n"
      "HEIGHT 1\n"
      "VIEWPOINT 0.5 0 2 0 1 0 0\n"
      "POINTS 2\n"
      "DATA binary_compressed\n";
  EXPECT_EQ(file.substr(0, header.size()), header);
  const std::string planes = bytes_of(0.25F) + bytes_of(1.5F) + bytes_of(-0.5F) + bytes_of(2.0F) +
                             bytes_of(0.125F) + bytes_of(-3.0F) + bytes_of(0x00808080U) +
                             bytes_of(0x000102ffU) + bytes_of(0) + bytes_of(2);
  const std::string packed = lzf(planes);
  EXPECT_EQ(file.substr(header.size()), sizes(packed.size(), planes.size()) + packed);
}

TEST(WritePcd, RefusesAnUnevenCloud) {
  PointCloud cloud = small_cloud();
  cloud.labels.pop_back();
  EXPECT_THROW(written(cloud), std::invalid_argument);
}

TEST(WritePcd, WritesTheSameBytesWhateverCameBefore) {
  const std::string once = written(small_cloud());
  PointCloud other;
  other.points.assign(5000, Eigen::Vector3f(0.25F, 1.5F, -0.5F));
  other.width = 5000;
  written(other);
  EXPECT_EQ(written(small_cloud()), once);
}

RC_GTEST_PROP(Pcd, ComesBackAsItWas, ()) {
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

TEST(Pcd, OfNoPointsComesBackEmpty) {
  EXPECT_THAT(read(written(PointCloud{})).points, IsEmpty());
}

TEST(Pcd, OfPointsThatDoNotCompressComesBackAsItWas) {
  PointCloud cloud;
  cloud.width = 10'000;
  std::uint32_t bits = 1;
  const auto noise = [&] {
    bits = bits * 1664525U + 1013904223U;  // Knuth's linear congruential generator
    return std::bit_cast<float>((bits & 0x3fffffffU) | 0x00800000U);
  };
  for (std::size_t i = 0; i < cloud.width; ++i) {
    const float x = noise();
    const float y = noise();
    cloud.points.emplace_back(x, y, noise());
  }
  const std::string file = written(cloud);
  EXPECT_TRUE(same_properties(read(file), cloud));
}

TEST(Pcd, KeepsTheViewpoint) {
  PointCloud cloud = small_cloud();
  cloud.viewpoint = Eigen::Translation3d(1.0 / 3.0, -7e-9, 2.0) *
                    Eigen::AngleAxisd(2.5, Eigen::Vector3d(1.0, 2.0, -0.5).normalized());
  const PointCloud back = read(written(cloud));
  ASSERT_TRUE(back.viewpoint);
  EXPECT_EQ(back.viewpoint->translation(), cloud.viewpoint->translation());
  EXPECT_TRUE(back.viewpoint->linear().isApprox(cloud.viewpoint->linear(), 1e-15));
}

// ---- reading what others write

std::string header(const std::string& fields, const std::string& data = "ascii", int points = 2) {
  return fmt::format(
      "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n{}WIDTH {}\nHEIGHT 1\n"
      "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS {}\nDATA {}\n",
      fields, points, points, data);
}

const std::string xyz = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n";

struct Field {
  std::string name;
  std::string type;  // "F 4"
  std::size_t count;
  std::function<std::string(std::size_t, bool)> values;  // of a point, in binary or in text
};

template <class T>
std::string shown(T value, bool binary) {
  return binary ? bytes_of(value) : fmt::format("{} ", value);
}

Field coordinate(const PointCloud& cloud, int axis) {
  const std::string name(1, "xyz"[axis]);
  if (*rc::gen::arbitrary<bool>()) {
    return {name, "F 8", 1, [&cloud, axis](std::size_t i, bool binary) {
              return shown(static_cast<double>(cloud.points[i][axis]), binary);
            }};
  }
  return {name, "F 4", 1,
          [&cloud, axis](std::size_t i, bool binary) { return shown(cloud.points[i][axis], binary); }};
}

std::uint32_t packed(const Color& color) {
  return std::uint32_t{color[0]} << 16 | std::uint32_t{color[1]} << 8 | std::uint32_t{color[2]};
}

std::vector<Field> any_fields_of(const PointCloud& cloud) {
  std::vector<Field> fields{coordinate(cloud, 0), coordinate(cloud, 1), coordinate(cloud, 2)};
  if (!cloud.colors.empty()) {
    const std::string name = *rc::gen::element<std::string>("rgb", "rgba");
    if (*rc::gen::arbitrary<bool>()) {
      fields.push_back({name, "F 4", 1, [&cloud](std::size_t i, bool binary) {
                          return shown(std::bit_cast<float>(packed(cloud.colors[i])), binary);
                        }});
    } else {
      const std::uint32_t alpha = name == "rgba" ? 0xff000000U : 0;
      fields.push_back({name, "U 4", 1, [&cloud, alpha](std::size_t i, bool binary) {
                          return shown(packed(cloud.colors[i]) | alpha, binary);
                        }});
    }
  }
  if (!cloud.labels.empty()) {
    if (*rc::gen::arbitrary<bool>()) {
      fields.push_back({"label", "I 2", 1, [&cloud](std::size_t i, bool binary) {
                          return shown(static_cast<std::int16_t>(cloud.labels[i]), binary);
                        }});
    } else {
      fields.push_back({"label", "U 4", 1, [&cloud](std::size_t i, bool binary) {
                          return shown(static_cast<std::uint32_t>(cloud.labels[i]), binary);
                        }});
    }
  }
  fields.push_back({"fpfh", "F 4", 3, [](std::size_t, bool binary) {
                      return shown(0.5F, binary) + shown(1.5F, binary) + shown(2.5F, binary);
                    }});
  fields.push_back(
      {"time", "U 8", 1, [](std::size_t i, bool binary) { return shown(std::uint64_t{i}, binary); }});
  for (std::size_t i = fields.size(); i > 1; --i) {
    std::swap(fields[i - 1], fields[*rc::gen::inRange<std::size_t>(0, i)]);
  }
  return fields;
}

std::string body(const std::vector<Field>& fields, std::size_t points, const std::string& data) {
  std::string bytes;
  if (data == "binary_compressed") {
    for (const Field& field : fields) {
      for (std::size_t i = 0; i < points; ++i) bytes += field.values(i, true);
    }
    const std::string packed_bytes = lzf(bytes);
    return sizes(packed_bytes.size(), bytes.size()) + packed_bytes;
  }
  for (std::size_t i = 0; i < points; ++i) {
    for (const Field& field : fields) bytes += field.values(i, data == "binary");
    if (data == "ascii") bytes += '\n';
  }
  return bytes;
}

RC_GTEST_PROP(ReadPcd, ReadsEveryFormatTypeAndOrder, ()) {
  PointCloud cloud = *any_cloud();
  cloud.points[0].y() = *rc::gen::element(0.5F, nan, std::numeric_limits<float>::infinity());
  const auto fields = any_fields_of(cloud);
  const auto data = *rc::gen::element<std::string>("ascii", "binary", "binary_compressed");
  std::array<std::string, 4> lines{"FIELDS", "SIZE", "TYPE", "COUNT"};
  for (const Field& field : fields) {
    lines[0] += " " + field.name;
    lines[1] += std::string(" ") + field.type[2];
    lines[2] += std::string(" ") + field.type[0];
    lines[3] += fmt::format(" {}", field.count);
  }
  const std::string head =
      header(fmt::format("{}\n", fmt::join(lines, "\n")), data, static_cast<int>(cloud.points.size()));
  RC_ASSERT(same_properties(read(head + body(fields, cloud.points.size(), data)), cloud));
}

TEST(ReadPcd, ReadsAnOlderHeaderWithCarriageReturnsBlankLinesAndComments) {
  const PointCloud cloud = read(
      "# hand-made\r\n\r\nVERSION .6\r\nFIELDS z y x\r\nSIZE 4 4 4\r\nTYPE F F F\r\n"
      "# no COUNT, no VIEWPOINT, no POINTS\r\nWIDTH 1\r\nHEIGHT 2\r\nDATA ascii\r\n"
      "1 2 3\r\nnan nan NaN\r\n\r\n");
  ASSERT_EQ(cloud.points.size(), 2U);
  EXPECT_EQ(cloud.points[0], Eigen::Vector3f(3, 2, 1));
  EXPECT_TRUE(same_point(cloud.points[1], Eigen::Vector3f::Constant(nan)));
  EXPECT_EQ(cloud.width, 1U);
  EXPECT_EQ(cloud.height, 2U);
}

TEST(ReadPcd, ReadsPaddingAsPclWritesIt) {
  const std::string fields =
      "FIELDS x y z _ label _\nSIZE 4 4 4 1 4 1\nTYPE F F F U U U\nCOUNT 1 1 1 4 1 12\n";
  const PointCloud cloud = read(header(fields, "binary", 1) + bytes_of(1.0F) + bytes_of(2.0F) +
                                bytes_of(3.0F) + "...." + bytes_of(7) + "............");
  EXPECT_THAT(cloud.points, ElementsAre(Eigen::Vector3f(1, 2, 3)));
  EXPECT_THAT(cloud.labels, ElementsAre(7));
}

TEST(ReadPcd, PassesOverTheZerosThatPclLeavesUpToTheEndOfAPage) {
  const std::string binary = header(xyz, "binary") + std::string(24, '\0');
  EXPECT_EQ(read(binary + std::string(4096, '\0')).points.size(), 2U);
  EXPECT_EQ(complaint_about(binary + std::string(65537, '\0')),
            "cloud.pcd: data after the last point that the header declares");
}

TEST(ReadPcd, TakesTheIdentityForAnUnknownViewpoint) {
  EXPECT_FALSE(read(header(xyz) + "1 2 3\n1 2 3\n").viewpoint);
}

TEST(ReadPcd, ReadsAFile) {
  const test::TemporaryDirectory directory;
  const auto file = directory / "cloud.pcd";
  {
    std::ofstream stream(file, std::ios::binary);
    write_pcd(stream, small_cloud());
  }
  EXPECT_TRUE(same_properties(read_pcd(file), small_cloud()));
}

// ---- bad input

TEST(ReadPcd, SaysWhatIsWrongWithAFile) {
  EXPECT_EQ(complaint([] { read_pcd(std::filesystem::path("no/such.pcd")); }),
            "no/such.pcd: cannot be opened: No such file or directory");
  EXPECT_EQ(complaint_about(""), "cloud.pcd: found an empty file, expected a PCD file");
  EXPECT_EQ(complaint_about("# PCD\nVERSION 0.7\n"), "cloud.pcd:2: found the end of the file, expected DATA");
  EXPECT_EQ(complaint_about("ply\n"),
            "cloud.pcd:1: found 'ply', expected one of VERSION, FIELDS, SIZE, TYPE, COUNT, WIDTH, HEIGHT, "
            "VIEWPOINT, POINTS, DATA");
  for (const std::string line : {"seed = 1", "[camera]"}) {
    EXPECT_EQ(complaint_about("# A recipe\n" + line + "\n"),
              "cloud.pcd:2: found TOML, as in a recipe or a scene file, expected a cloud: a PLY or PCD file");
  }
  EXPECT_EQ(complaint_about("VERSION 0.7\nVERSION 0.7\n"), "cloud.pcd:2: VERSION: given twice");
  EXPECT_EQ(complaint_about("VERSION 0.7\nDATA ascii\n"), "cloud.pcd: header has no WIDTH");
  EXPECT_EQ(complaint_about("VERSION 0.5\nDATA ascii\n"),
            "cloud.pcd:1: VERSION: found '0.5', expected 0.7 or 0.6");
  EXPECT_EQ(complaint_about("VERSION\nDATA ascii\n"), "cloud.pcd:1: VERSION: found 0 values, expected 1");
}

TEST(ReadPcd, SaysWhatIsWrongWithSizes) {
  const std::string start = "VERSION 0.7\n" + xyz;
  EXPECT_EQ(complaint_about(start + "WIDTH -1\nHEIGHT 1\nDATA ascii\n"),
            "cloud.pcd:6: WIDTH: found '-1', expected an integer from 0 to 4294967295");
  EXPECT_EQ(complaint_about(start + "WIDTH 1\nHEIGHT 4294967296\nDATA ascii\n"),
            "cloud.pcd:7: HEIGHT: found '4294967296', expected an integer from 0 to 4294967295");
  EXPECT_EQ(complaint_about(start + "WIDTH 2\nHEIGHT 3\nPOINTS 5\nDATA ascii\n"),
            "cloud.pcd:8: POINTS: found 5, expected WIDTH x HEIGHT = 6");
  EXPECT_EQ(complaint_about(start + "WIDTH 2\nHEIGHT 3\nDATA text\n"),
            "cloud.pcd:8: DATA: found 'text', expected ascii, binary or binary_compressed");
}

TEST(ReadPcd, SaysWhatIsWrongWithFields) {
  const auto about = [](const std::string& fields) { return complaint_about(header(fields)); };
  EXPECT_EQ(about("FIELDS x y z\nSIZE 4 4\nTYPE F F F\n"), "cloud.pcd:4: SIZE: found 2 values, expected 3");
  EXPECT_EQ(about("FIELDS x y z\nSIZE 4 4 4\nTYPE F F F F\n"),
            "cloud.pcd:5: TYPE: found 4 values, expected 3");
  EXPECT_EQ(about("FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1\n"),
            "cloud.pcd:6: COUNT: found 1 values, expected 3");
  EXPECT_EQ(about("FIELDS x y z n\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 0\n"),
            "cloud.pcd:6: COUNT: found 0, expected 1 or more");
  EXPECT_EQ(about("FIELDS x y z n\nSIZE 4 4 4 3\nTYPE F F F I\n"),
            "cloud.pcd:5: n: found type 'I 3', expected F of 4 or 8 bytes, I or U of 1, 2, 4 or 8");
  EXPECT_EQ(about("FIELDS x y z\nSIZE 4 4 4\nTYPE F I F\n"),
            "cloud.pcd:5: y: found type I 4, expected F 4 or F 8");
  EXPECT_EQ(about("FIELDS x y z rgb\nSIZE 4 4 4 1\nTYPE F F F U\n"),
            "cloud.pcd:5: rgb: found type U 1, expected F 4 or U 4");
  EXPECT_EQ(about("FIELDS x y z label\nSIZE 4 4 4 4\nTYPE F F F F\n"),
            "cloud.pcd:5: label: found type F 4, expected I or U");
  EXPECT_EQ(about("FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 2 1\n"),
            "cloud.pcd:5: y: found COUNT 2, expected 1");
  EXPECT_EQ(about("FIELDS x y y\nSIZE 4 4 4\nTYPE F F F\n"), "cloud.pcd:3: FIELDS: field 'y' given twice");
  EXPECT_EQ(about("FIELDS x y\nSIZE 4 4\nTYPE F F\n"), "cloud.pcd:3: FIELDS: no field z");
  EXPECT_EQ(about("FIELDS x y z rgb rgba\nSIZE 4 4 4 4 4\nTYPE F F F U U\n"),
            "cloud.pcd:3: FIELDS: found both rgb and rgba, expected one of them");
  EXPECT_EQ(about("FIELDS x y z n\nSIZE 4 4 4 8\nTYPE F F F F\nCOUNT 1 1 1 4000000000\n"),
            "cloud.pcd:3: FIELDS: found 32000000012 bytes a point, expected at most 1048576");
}

TEST(ReadPcd, SaysWhatIsWrongWithTheViewpoint) {
  const auto about = [](const std::string& viewpoint) {
    return complaint_about("VERSION 0.7\n" + xyz + "WIDTH 0\nHEIGHT 1\n" + viewpoint + "\nDATA ascii\n");
  };
  EXPECT_EQ(about("VIEWPOINT 0 0 0"), "cloud.pcd:8: VIEWPOINT: found 3 values, expected 7");
  EXPECT_EQ(about("VIEWPOINT 0 0 nan 1 0 0 0"),
            "cloud.pcd:8: VIEWPOINT: found 'nan', expected a finite number");
  EXPECT_EQ(about("VIEWPOINT 0 0 0 0 0 0 0"),
            "cloud.pcd:8: VIEWPOINT: found a quaternion of length 0, expected 1");
}

TEST(ReadPcd, SaysWhatIsWrongWithPoints) {
  EXPECT_EQ(complaint_about(header(xyz) + "1 2 3\n1 2\n"), "cloud.pcd:13: found 2 values, expected 3");
  EXPECT_EQ(complaint_about(header(xyz) + "1 2 3\n1 2 x\n"),
            "cloud.pcd:13: z: found 'x', expected a 32-bit floating-point number");
  EXPECT_EQ(complaint_about(header(xyz) + "1 2 3\n1 2 3\n1 2 3\n"),
            "cloud.pcd:14: found '1 2 3', expected the end of the file");
  EXPECT_EQ(complaint_about(header("FIELDS x y z label\nSIZE 4 4 4 8\nTYPE F F F I\n") +
                            "1 2 3 -3000000000\n1 2 3 4\n"),
            "cloud.pcd:11: label: found -3000000000, expected a label from -1 to 2147483647");
  // Written as an unsigned number, it would not come back.
  const std::string labelled = header("FIELDS x y z label\nSIZE 4 4 4 2\nTYPE F F F I\n", "binary", 1);
  EXPECT_EQ(complaint_about(labelled + std::string(12, '\0') + bytes_of(std::int16_t{-6145})),
            "cloud.pcd: label of point 1: found -6145, expected a label from -1 to 2147483647");
  EXPECT_EQ(complaint_about(header(xyz, "binary") + std::string(23, '\0')),
            "cloud.pcd: POINTS: found 1 before the end of the file, expected 2");
  EXPECT_EQ(complaint_about(header(xyz, "binary") + std::string(25, '\1')),
            "cloud.pcd: data after the last point that the header declares");
}

TEST(ReadPcd, SaysWhatIsWrongWithCompressedPoints) {
  const std::string head = header(xyz, "binary_compressed");
  const std::string packed = lzf(std::string(24, '\0'));
  EXPECT_TRUE(read(head + sizes(packed.size(), 24) + packed).points[1].isZero());
  EXPECT_EQ(complaint_about(head + "12345"),
            "cloud.pcd: DATA: found 5 bytes before the end of the file, expected 8");
  EXPECT_EQ(complaint_about(head + sizes(packed.size(), 12) + packed),
            "cloud.pcd: DATA: found an uncompressed size of 12 bytes, expected 2 points of 12 bytes");
  EXPECT_EQ(complaint_about(head + sizes(packed.size() + 4, 24) + packed),
            fmt::format("cloud.pcd: DATA: found {} bytes before the end of the file, expected {}",
                        packed.size(), packed.size() + 4));
  EXPECT_EQ(complaint_about(head + sizes(0, 24)),
            "cloud.pcd: DATA: found a compressed size of 0 bytes, expected at least 1");
  EXPECT_EQ(complaint_about(head + sizes(3, 24) + std::string(3, '\xff')),
            "cloud.pcd: DATA: compressed data is damaged");
  EXPECT_EQ(complaint_about(head + sizes(packed.size(), 24) + packed + "x"),
            "cloud.pcd: data after the last point that the header declares");
  // Claims four gigabytes; has none.
  EXPECT_EQ(
      complaint_about(header(xyz, "binary_compressed", 300'000'000) + sizes(1'000'000'000, 3'600'000'000)),
      "cloud.pcd: DATA: found 0 bytes before the end of the file, expected 1000000000");
  EXPECT_EQ(complaint_about(header(xyz, "binary_compressed", 300'000'000) + sizes(1000, 3'600'000'000)),
            "cloud.pcd: DATA: found a compressed size of 1000 bytes, expected at least 40909091");
}

TEST(ReadPcd, ComplainsOfAFileCutAnywhere) {
  const std::string text = header("FIELDS x y z label\nSIZE 4 4 4 4\nTYPE F F F I\n") + "1 2 3 4\n5 6 7 8";
  const std::string binary = header(xyz, "binary") + std::string(24, '\0');
  for (const std::string& whole : {written(small_cloud()), text, binary}) {
    for (std::size_t size = 0; size < whole.size(); ++size) {
      EXPECT_NE(complaint_about(whole.substr(0, size)), "none") << size << " bytes";
    }
  }
}

TEST(Pcd, KeepsNormalsIntensitiesAndMixedPoints) {
  const PointCloud cloud = cloud_of_a_sensor();
  std::stringstream file;
  write_pcd(file, cloud);
  const PointCloud read = read_pcd(file, "cloud");
  expect_same_sensor_properties(read, cloud);
}

}  // namespace
}  // namespace tanglebin
