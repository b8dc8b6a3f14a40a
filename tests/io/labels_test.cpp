#include "tanglebin/io/labels.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <sstream>
#include <string>

#include "tanglebin/io/ply.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/temporary_directory.hpp"

namespace tanglebin {
namespace {

using test::complaint;
using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::int32_t> labels_in(const std::string& bytes) {
  std::istringstream in(bytes);
  return std::get<std::vector<std::int32_t>>(read_labels(in, "out"));
}

// As numpy.save() writes an array.
template <typename Integer>
std::string npy(const std::string& descr, const std::vector<Integer>& values, const std::string& shape) {
  std::string header = "{'descr': '" + descr + "', 'fortran_order': False, 'shape': " + shape + ", }";
  header.append((64 - (10 + header.size() + 1) % 64) % 64, ' ');
  header += '\n';
  std::string bytes = std::string("\x93NUMPY\x01\x00", 8);
  bytes += static_cast<char>(header.size() & 0xFFU);
  bytes += static_cast<char>(header.size() >> 8U);
  bytes += header;
  if (!values.empty())
    bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Integer));
  return bytes;
}

TEST(ReadLabels, FromTextWithOneOnEachLine) {
  EXPECT_THAT(labels_in("1\n 2 \r\n-1\n0"), ElementsAre(1, 2, -1, 0));
  EXPECT_TRUE(labels_in("").empty());
}

TEST(ReadLabels, FromAnArrayOfIntegersOfAnySize) {
  EXPECT_THAT(labels_in(npy<std::int32_t>("<i4", {1, -1, 70000}, "(3,)")), ElementsAre(1, -1, 70000));
  EXPECT_THAT(labels_in(npy<std::int64_t>("<i8", {1, -1, 70000}, "(3,)")), ElementsAre(1, -1, 70000));
  EXPECT_THAT(labels_in(npy<std::int16_t>("<i2", {5, -1}, "(2,)")), ElementsAre(5, -1));
  EXPECT_THAT(labels_in(npy<std::int8_t>("|i1", {5, -1}, "(2,)")), ElementsAre(5, -1));
  EXPECT_THAT(labels_in(npy<std::uint8_t>("|u1", {5, 255}, "(2,)")), ElementsAre(5, 255));
  EXPECT_THAT(labels_in(npy<std::uint16_t>("<u2", {5, 65535}, "(2,)")), ElementsAre(5, 65535));
  EXPECT_THAT(labels_in(npy<std::uint32_t>("<u4", {5}, "(1,)")), ElementsAre(5));
}

RC_GTEST_PROP(ReadLabels, ComeBackFromTextAndFromAnArray, (const std::vector<std::uint16_t>& values)) {
  const std::vector<std::int32_t> labels(values.begin(), values.end());
  std::string text;
  for (const std::int32_t label : labels) text += std::to_string(label) + '\n';
  RC_ASSERT(labels_in(text) == labels);
  RC_ASSERT(labels_in(npy("<i4", labels, "(" + std::to_string(labels.size()) + ",)")) == labels);
}

TEST(ReadLabels, FromACloud) {
  PointCloud cloud;
  cloud.points = {{1, 2, 3}};
  cloud.labels = {4};
  cloud.width = 1;
  std::stringstream file;
  write_ply(file, cloud);
  EXPECT_EQ(std::get<PointCloud>(read_labels(file, "out")).labels, cloud.labels);
}

TEST(ReadLabels, SayWhatIsWrongAndWhere) {
  const auto complaint_about = [](const std::string& bytes) { return complaint([&] { labels_in(bytes); }); };
  EXPECT_EQ(complaint_about("1\n2.5\n"),
            "out:2: found '2.5', expected a label: an integer from -1 to 2147483647");
  EXPECT_THAT(complaint_about("1 2\n"), HasSubstr("out:1: found '1 2'"));
  EXPECT_THAT(complaint_about("-2\n"), HasSubstr("found '-2'"));
  EXPECT_THAT(complaint_about("\n"), HasSubstr("out:1: "));
  EXPECT_THAT(complaint_about(npy<std::int64_t>("<i8", {1, 1L << 40}, "(2,)")),
              HasSubstr("out: label 2: found 1099511627776"));
  EXPECT_THAT(complaint_about(npy<float>("<f4", {1}, "(1,)")),
              HasSubstr("descr: found '<f4', expected integers"));
  EXPECT_THAT(complaint_about(npy<std::int32_t>("<i4", {1, 2}, "(1, 2)")), HasSubstr("shape: found (1, 2)"));
  EXPECT_THAT(complaint_about(npy<std::int32_t>("<i4", {1, 2}, "(4000000000,)")),
              HasSubstr("found 2 labels, expected 4000000000"));
  EXPECT_THAT(complaint_about(npy<std::int32_t>("<i4", {1, 2}, "(1,)")), HasSubstr("after the last label"));
  EXPECT_THAT(complaint([] { read_labels("/nowhere/out.npy"); }), HasSubstr("/nowhere/out.npy: is missing"));
}

}  // namespace
}  // namespace tanglebin
