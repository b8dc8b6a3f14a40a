#include "tanglebin/io/read_tubes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "tests/support/complaint.hpp"
#include "tests/support/temporary_directory.hpp"

namespace tanglebin {
namespace {

using testing::HasSubstr;

// A bent tube and a straight one that is cut flat, with all that `model` writes of them.
const std::string two_tubes =
    R"({"format":1,"frame":"world","unit":"m","usable":true,"points":{"all":9},"findings":[],"tubes":[)"
    R"({"id":1,"radius":0.0125,"ends":"round","nodes":[[-0.2,0,0.0125],[0,0.02,0.0125],[0.2,0,0.0125]],)"
    R"("edges":[[0,1],[1,2]],"confidence":0.99,"joins":[]},)"
    R"({"id":4,"radius":0.01,"ends":"flat","nodes":[[0,0,0.1],[0,0,0.3]],"edges":[[1,0]],"confidence":0.5}]})";

std::vector<Tube> read(const std::string& text) {
  std::istringstream in(text);
  return read_tubes(in, "tubes.json");
}

// What is said after one change of the text.
std::string complaint_after(const std::string& old_text, const std::string& new_text) {
  std::string text = two_tubes;
  const std::size_t place = text.find(old_text);
  EXPECT_NE(place, std::string::npos) << "the example has no " << old_text;
  text.replace(place, old_text.size(), new_text);
  return test::complaint([&] { read(text); });
}

TEST(ReadTubes, OfJsonHaveTheirShape) {
  const std::vector<Tube> tubes = read(two_tubes);
  ASSERT_EQ(tubes.size(), 2U);
  EXPECT_EQ(tubes[0].id, 1);
  EXPECT_EQ(tubes[0].radius, 0.0125);
  EXPECT_FALSE(tubes[0].flat_ends);
  ASSERT_EQ(tubes[0].nodes.size(), 3U);
  EXPECT_EQ(tubes[0].nodes[1].position, Eigen::Vector3d(0, 0.02, 0.0125));
  ASSERT_EQ(tubes[0].edges.size(), 2U);
  EXPECT_EQ(tubes[0].edges[1].from, 1U);
  EXPECT_EQ(tubes[0].edges[1].to, 2U);
  EXPECT_EQ(tubes[1].id, 4);
  EXPECT_TRUE(tubes[1].flat_ends);
  EXPECT_TRUE(read(R"({"format":1,"frame":"world","unit":"m","tubes":[]})").empty());
}

TEST(ReadTubes, OfAConfigurationAreReadAsThat) {
  const test::TemporaryDirectory directory;
  test::write_bytes(directory / "tubes.txt",
                    "1\n2 2 1\n1 0 0 0 0.01\n2 0 0 0.3 0.01\n"
                    "e_1_2 1 2 1 0.01 0 0 0.15 1 0 0 0 0.3\n");
  EXPECT_EQ(read_tubes(directory / "tubes.txt").at(0).id, 2);
  EXPECT_THAT(test::complaint([&] { read_tubes(directory / "absent.txt"); }), HasSubstr("cannot be opened"));
  EXPECT_THAT(test::complaint([] { read("no tubes"); }), HasSubstr("tubes.json:1"));
}

TEST(ReadTubes, SayWhatIsWrongWithTheJson) {
  EXPECT_THAT(complaint_after("\"format\":1", "\"format\":2"),
              HasSubstr("tubes.json: format: found 2, expected 1"));
  EXPECT_THAT(complaint_after("world", "camera"), HasSubstr("frame: found 'camera', expected 'world'"));
  EXPECT_THAT(complaint_after("\"m\"", "\"mm\""), HasSubstr("unit: found 'mm', expected 'm'"));
  EXPECT_THAT(complaint_after("\"id\":4", "\"id\":1"), HasSubstr("tubes[1].id: found 1 twice"));
  EXPECT_THAT(complaint_after("0.0125,\"ends", "0,\"ends"), HasSubstr("tubes[0].radius: found 0"));
  EXPECT_THAT(complaint_after("flat", "blunt"), HasSubstr("tubes[1].ends: found 'blunt'"));
  EXPECT_THAT(complaint_after("[0,0.02,0.0125]", "[0,0.02]"),
              HasSubstr("tubes[0].nodes[1]: found '[0,0.02]'"));
  EXPECT_THAT(complaint_after("[0,0,0.3]", "[0,0,null]"), HasSubstr("three numbers"));
  EXPECT_THAT(complaint_after(",[0,0,0.3]", ""), HasSubstr("tubes[1].nodes: found 1, expected at least 2"));
  EXPECT_THAT(complaint_after("[1,2]", "[1,3]"), HasSubstr("the index of a node, 0 to 2"));
  EXPECT_THAT(complaint_after("[1,2]", "[1,-2]"), HasSubstr("the index of a node, 0 to 2"));
  EXPECT_THAT(complaint_after("[1,2]", "[1,0]"), HasSubstr("found [1,0], which closes a loop"));
  EXPECT_THAT(complaint_after("[0,1],", ""), HasSubstr("tubes[0].edges: found 1, expected 2"));
  EXPECT_THAT(complaint_after("\"edges\":[[1,0]]", "\"edges\":7"),
              HasSubstr("tubes[1].edges: found no list"));
  EXPECT_THAT(complaint_after("[]}", "[]"), HasSubstr("expected a JSON object"));
}

}  // namespace
}  // namespace tanglebin
