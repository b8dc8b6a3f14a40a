#include "tanglebin/io/configuration.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <locale>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/complaint.hpp"

namespace tanglebin {
namespace {

using ::testing::HasSubstr;

// A bent tube whose nodes are in no particular order, and a straight one.
const std::string two_tubes =
    "2\n"
    "1 3 2\n"
    "2 0.1 0.2 0.1 0.0125\n"
    "1 0 0 0.1 0.0125\n"
    "4 0.1 0 0.1 0.0125\n"
    "e_1_4 1 4 1 0.0125 0.05 0 0.1 0.707106781 0 0.707106781 0 0.1\n"
    "e_4_2 4 2 2 0.0125 0.1 0.1 0.1 0.707106781 -0.707106781 0 0 0.2\n"
    "2 2 1\n"
    "1 0 0 0 0.01\n"
    "2 0 0 0.3 0.01\n"
    "e_1_2 1 2 1 0.01 0 0 0.15 1 0 0 0 0.3\n";

std::vector<Tube> read(const std::string& text) {
  std::istringstream in(text);
  return read_configuration(in, "tubes.txt");
}

std::string write(const std::vector<Tube>& tubes) {
  std::ostringstream out;
  write_configuration(out, tubes);
  return out.str();
}

std::string complaint(const std::string& text) {
  return test::complaint([&] { read(text); });
}

// What is said of the two tubes after one change of their text.
std::string complaint_after(const std::string& old_text, const std::string& new_text) {
  std::string text = two_tubes;
  const std::size_t place = text.find(old_text);
  EXPECT_NE(place, std::string::npos) << "the example has no " << old_text;
  return complaint(text.replace(place, old_text.size(), new_text));
}

std::string contents(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// The text, of each edge only name, nodes, order and radius.
std::string without_frames(const std::string& text) {
  constexpr int fields_kept = 5;
  std::istringstream lines(text);
  std::string result;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream fields(line);
    int field = 0;
    for (std::string word; fields >> word && (line[0] != 'e' || field < fields_kept); ++field)
      result += word + ' ';
    result += '\n';
  }
  return result;
}

std::vector<std::string> words(const std::string& text) {
  std::istringstream in(text);
  return {std::istream_iterator<std::string>(in), {}};
}

void expect_same(const Tube& tube, const Tube& other) {
  EXPECT_EQ(tube.id, other.id);
  EXPECT_EQ(tube.radius, other.radius);
  ASSERT_EQ(tube.nodes.size(), other.nodes.size());
  for (std::size_t i = 0; i < tube.nodes.size(); ++i) {
    EXPECT_EQ(tube.nodes[i].id, other.nodes[i].id);
    EXPECT_EQ(tube.nodes[i].position, other.nodes[i].position);
  }
  ASSERT_EQ(tube.edges.size(), other.edges.size());
  for (std::size_t i = 0; i < tube.edges.size(); ++i) {
    EXPECT_EQ(tube.edges[i].from, other.edges[i].from);
    EXPECT_EQ(tube.edges[i].to, other.edges[i].to);
    EXPECT_EQ(tube.edges[i].order, other.edges[i].order);
  }
}

TEST(Configuration, ReadsEachFieldIntoItsPlace) {
  const std::vector<Tube> tubes = read(two_tubes);

  ASSERT_EQ(tubes.size(), 2U);
  EXPECT_EQ(tubes[0].id, 1);
  EXPECT_EQ(tubes[0].radius, 0.0125);
  EXPECT_EQ(tubes[0].mass, 0.0) << "the format does not carry the mass";
  ASSERT_EQ(tubes[0].nodes.size(), 3U);
  EXPECT_EQ(tubes[0].nodes[0].id, 2) << "nodes stay in the order of the file";
  EXPECT_EQ(tubes[0].nodes[0].position, Eigen::Vector3d(0.1, 0.2, 0.1));
  ASSERT_EQ(tubes[0].edges.size(), 2U);
  const Edge& edge = tubes[0].edges[1];
  EXPECT_EQ(edge.from, 2U);
  EXPECT_EQ(edge.to, 0U);
  EXPECT_EQ(edge.order, 2);
  EXPECT_EQ(tubes[1].id, 2);
  EXPECT_EQ(tubes[1].radius, 0.01);
}

TEST(Configuration, WritesWhatItRead) {
  EXPECT_EQ(write(read(two_tubes)), two_tubes);
}

// A list of tubes that were made without ids.
TEST(Configuration, WritesNoTubesThatItCouldNotRead) {
  std::vector<Tube> tubes = read(two_tubes);
  tubes[1].id = tubes[0].id;
  EXPECT_EQ(test::complaint([&] { write(tubes); }), "id: found 1 twice, expected distinct ids");
  tubes[1].id = 0;
  EXPECT_EQ(test::complaint([&] { write(tubes); }), "id of tube 0: found 0, expected 1 or more");
}

TEST(Configuration, TakesOtherLineEndsAndBlanks) {
  const std::string no_last_newline = two_tubes.substr(0, two_tubes.size() - 1);
  EXPECT_EQ(write(read(no_last_newline)), two_tubes);
  EXPECT_EQ(write(read(two_tubes + "\n \n")), two_tubes);
  std::string windows;
  for (const char c : two_tubes) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
  EXPECT_EQ(write(read(windows)), two_tubes);
}

TEST(Configuration, KnowsScenesWithoutTubes) {
  EXPECT_TRUE(read("0\n").empty());
  EXPECT_EQ(write({}), "0\n");
}

// Centre, rotation and length of an edge follow from its nodes and are not kept: a file from elsewhere may
// have them with fewer digits, or the cylinder turned about its own axis.
TEST(Configuration, GivesEveryPublishedFileBackButForWhatFollowsFromTheNodes) {
  if (!std::filesystem::exists(TANGLEBIN_PUBLISHED)) GTEST_SKIP() << "no " << TANGLEBIN_PUBLISHED;
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(TANGLEBIN_PUBLISHED)) {
    if (entry.path().extension() != ".txt") continue;
    ++files;
    const std::string text = contents(entry.path());
    const std::string again = write(read(text));
    EXPECT_EQ(without_frames(again), without_frames(text)) << entry.path();
    EXPECT_EQ(write(read(again)), again) << entry.path();
  }
  EXPECT_EQ(files, 10);
}

TEST(Configuration, ReadsEveryNumberOfAPublishedFileAsItStandsThere) {
  const std::filesystem::path file = std::filesystem::path(TANGLEBIN_PUBLISHED) / "C1_1.txt";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file;
  const Tube tube = read_configuration(file).at(0);
  const std::vector<std::string> text = words(contents(file));

  ASSERT_EQ(text.size(), 1 + 3 + 20 * 5 + 19 * 13U);
  const auto number = [&text](std::size_t index) { return std::stod(text.at(index)); };
  for (std::size_t i = 0; i < 20; ++i) {
    EXPECT_EQ(tube.nodes.at(i).id, number(4 + 5 * i));
    for (Eigen::Index axis = 0; axis < 3; ++axis)
      EXPECT_EQ(tube.nodes[i].position[axis], number(5 + 5 * i + static_cast<std::size_t>(axis)));
  }
  for (std::size_t i = 0; i < 19; ++i) {
    const std::size_t line = 104 + 13 * i;
    const Edge& edge = tube.edges.at(i);
    EXPECT_EQ(tube.nodes.at(edge.from).id, number(line + 1));
    EXPECT_EQ(tube.nodes.at(edge.to).id, number(line + 2));
    EXPECT_EQ(edge.order, number(line + 3));
    const EdgeFrame frame = frame_of(tube, edge);
    const Eigen::Vector3d centre(number(line + 5), number(line + 6), number(line + 7));
    const Eigen::Quaterniond rotation(number(line + 8), number(line + 9), number(line + 10),
                                      number(line + 11));
    EXPECT_LT((frame.centre - centre).norm(), 2e-6);
    EXPECT_LT((frame.rotation * Eigen::Vector3d::UnitZ() - rotation * Eigen::Vector3d::UnitZ()).norm(), 1e-4);
    EXPECT_NEAR(frame.length, number(line + 12), 2e-6);
  }
}

TEST(Configuration, RefusesAPublishedFileThatLostALine) {
  const std::filesystem::path file = std::filesystem::path(TANGLEBIN_PUBLISHED) / "C1_1.txt";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file;
  const std::string text = contents(file);
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t next = text.find('\n', begin) + 1;
    EXPECT_NE(complaint(text.substr(0, begin) + text.substr(next)), "none")
        << text.substr(begin, next - begin);
    EXPECT_NE(complaint(text.substr(0, begin)), "none") << "cut before " << text.substr(begin, next - begin);
    begin = next;
  }
}

// Real numbers that use all their digits: a finite sum of small fractions.
double any_real(double low, double high) {
  const auto steps = *rc::gen::inRange<std::int64_t>(0, std::int64_t{1} << 52);
  return low + (high - low) * static_cast<double>(steps) / static_cast<double>(std::int64_t{1} << 52);
}

Tube any_tube(int id) {
  const int count = *rc::gen::inRange(2, 12);
  const auto ids =
      *rc::gen::unique<std::vector<int>>(static_cast<std::size_t>(count), rc::gen::inRange(1, 1000));
  Tube tube{.id = id, .radius = any_real(1e-6, 1), .mass = 0, .nodes = {}, .edges = {}};
  for (const int node : ids)
    tube.nodes.push_back({node, {any_real(-3, 3), any_real(-3, 3), any_real(-3, 3)}});
  for (std::size_t to = 1; to < tube.nodes.size(); ++to) {
    const std::size_t from = *rc::gen::inRange<std::size_t>(0, to);
    RC_PRE(tube.nodes[from].position != tube.nodes[to].position);
    tube.edges.push_back({from, to, static_cast<int>(to)});
  }
  return tube;
}

RC_GTEST_PROP(ConfigurationProperty, WhatIsWrittenReadsBackBitForBit, ()) {
  std::vector<Tube> tubes;
  const int count = *rc::gen::inRange(0, 4);
  for (int id = 1; id <= count; ++id) tubes.push_back(any_tube(id));

  const std::vector<Tube> again = read(write(tubes));

  RC_ASSERT(again.size() == tubes.size());
  for (std::size_t i = 0; i < tubes.size(); ++i) expect_same(again[i], tubes[i]);
  RC_ASSERT(write(again) == write(tubes));
}

struct CommaDecimals : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\1"; }
};

TEST(Configuration, IsTheSameInEveryLocale) {
  const std::locale comma(std::locale::classic(), new CommaDecimals);
  std::istringstream in(two_tubes);
  in.imbue(comma);
  std::ostringstream out;
  out.imbue(comma);
  write_configuration(out, read_configuration(in, "tubes.txt"));
  EXPECT_EQ(out.str(), two_tubes);
}

TEST(Configuration, NamesAFileThatIsMissing) {
  EXPECT_EQ(test::complaint([] { read_configuration(std::filesystem::path("/nowhere/tubes.txt")); }),
            "/nowhere/tubes.txt: cannot be opened: No such file or directory");
}

TEST(Configuration, NamesAFolderThatIsNoFile) {
  EXPECT_THAT(test::complaint([] { read_configuration(std::filesystem::temp_directory_path()); }),
              HasSubstr("is a directory"));
}

TEST(Configuration, SaysThatAFileIsEmpty) {
  EXPECT_EQ(complaint(""),
            "tubes.txt:1: number of tubes: found the end of the file, expected 1 field: tubes");
  EXPECT_EQ(complaint("\n"), "tubes.txt:1: number of tubes: found an empty line, expected 1 field: tubes");
}

TEST(Configuration, MarksATubeWithFlatEndsAndLeavesOthersAsTheyAre) {
  std::string text = two_tubes;
  text.replace(text.find("1 3 2\n"), 6, "1 3 2 flat\n");
  std::istringstream in(text);
  const std::vector<Tube> tubes = read_configuration(in, "tubes.txt");
  ASSERT_EQ(tubes.size(), 2U);
  EXPECT_TRUE(tubes[0].flat_ends);
  EXPECT_FALSE(tubes[1].flat_ends);
  std::ostringstream out;
  write_configuration(out, tubes);
  EXPECT_EQ(out.str(), text);
}

TEST(Configuration, KnowsNoEndsButFlatOnes) {
  EXPECT_EQ(complaint_after("1 3 2\n", "1 3 2 round\n"),
            "tubes.txt:2: ends: found 'round', expected flat, or nothing for round ends");
  EXPECT_EQ(
      complaint_after("1 3 2\n", "1 3 2 flat 1\n"),
      "tubes.txt:2: tube 1 of 2: found 5 fields from '1' on, expected 3 or 4 fields: id nodes edges ends");
}

TEST(Configuration, NoticesThatThereAreFewerTubesThanAnnounced) {
  EXPECT_EQ(
      complaint_after("2\n1 3 2", "3\n1 3 2"),
      "tubes.txt:12: tube 3 of 3: found the end of the file, expected 3 or 4 fields: id nodes edges ends");
}

TEST(Configuration, NoticesThatThereAreMoreTubesThanAnnounced) {
  EXPECT_EQ(complaint_after("2\n1 3 2", "1\n1 3 2"),
            "tubes.txt:8: found '2', expected the end of the file after tube 1 of 1");
}

TEST(Configuration, NoticesThatThereAreFewerNodesThanAnnounced) {
  EXPECT_EQ(complaint_after("1 3 2", "1 4 3"),
            "tubes.txt:6: node 4 of 4: found 13 fields from 'e_1_4' on, expected 5 fields: id x y z radius");
}

TEST(Configuration, NoticesThatThereAreMoreNodesThanAnnounced) {
  EXPECT_EQ(
      complaint_after("1 3 2", "1 2 1"),
      "tubes.txt:5: edge 1 of 1: found 5 fields from '4' on, expected 13 fields: name n1 n2 order radius "
      "cx cy cz qw qx qy qz length");
}

TEST(Configuration, NoticesThatThereAreFewerEdgesThanAnnounced) {
  EXPECT_EQ(
      complaint_after("e_4_2 4 2 2 0.0125 0.1 0.1 0.1 0.707106781 -0.707106781 0 0 0.2\n", ""),
      "tubes.txt:7: edge 2 of 2: found 3 fields from '2' on, expected 13 fields: name n1 n2 order radius "
      "cx cy cz qw qx qy qz length");
}

TEST(Configuration, NoticesThatThereAreMoreEdgesThanAnnounced) {
  const std::string edge = "e_1_4 1 4 1 0.0125 0.05 0 0.1 0.707106781 0 0.707106781 0 0.1\n";
  EXPECT_EQ(complaint_after("2 2 1\n", edge + "2 2 1\n"),
            "tubes.txt:8: tube 2 of 2: found 13 fields from 'e_1_4' on, expected 3 or 4 fields: id nodes "
            "edges ends");
}

TEST(Configuration, NoticesNumbersOfNodesAndEdgesThatMakeNoTree) {
  EXPECT_EQ(complaint_after("1 3 2", "1 3 3"),
            "tubes.txt:2: number of edges: found 3, expected 2, one less than the tree's 3 nodes");
  EXPECT_EQ(complaint_after("1 3 2", "1 1 0"),
            "tubes.txt:2: number of nodes: found '1', expected a whole number from 2 to 2147483647");
}

TEST(Configuration, DoesNotBelieveAbsurdCounts) {
  EXPECT_EQ(complaint("1000000000\n"),
            "tubes.txt:2: tube 1 of 1000000000: found the end of the file, expected 3 or 4 fields: id nodes "
            "edges ends");
  EXPECT_EQ(
      complaint("1\n1 1000000000 999999999\n"),
      "tubes.txt:3: node 1 of 1000000000: found the end of the file, expected 5 fields: id x y z radius");
  EXPECT_EQ(complaint("99999999999999999999\n"),
            "tubes.txt:1: number of tubes: found '99999999999999999999', expected a whole number from 0 to "
            "2147483647");
  EXPECT_EQ(complaint("-1\n"),
            "tubes.txt:1: number of tubes: found '-1', expected a whole number from 0 to 2147483647");
}

TEST(Configuration, NamesIdsThatAreThereTwice) {
  EXPECT_EQ(complaint_after("2 2 1\n", "1 2 1\n"),
            "tubes.txt:8: tube id: found 1 twice, expected distinct ids");
  EXPECT_EQ(complaint_after("4 0.1 0 0.1", "1 0.1 0 0.1"),
            "tubes.txt:5: node id: found 1 twice, expected distinct ids");
}

TEST(Configuration, NamesAnUnknownNodeOfAnEdge) {
  EXPECT_EQ(complaint_after("e_4_2 4 2", "e_4_7 4 7"),
            "tubes.txt:7: n2: found '7', expected the id of a node of tube 1");
  EXPECT_EQ(complaint_after("e_4_2 4 2", "e_x_2 x 2"),
            "tubes.txt:7: n1: found 'x', expected a whole number from 1 to 2147483647");
}

TEST(Configuration, NamesAnEdgeWhoseNameIsAnothersName) {
  EXPECT_EQ(complaint_after("e_4_2 4 2", "e_2_4 4 2"), "tubes.txt:7: name: found 'e_2_4', expected 'e_4_2'");
  EXPECT_EQ(complaint_after("e_4_2 4 2", "edge 4 2"), "tubes.txt:7: name: found 'edge', expected 'e_4_2'");
}

TEST(Configuration, NamesARadiusThatIsNone) {
  EXPECT_EQ(complaint_after("1 0 0 0.1 0.0125", "1 0 0 0.1 -0.0125"),
            "tubes.txt:4: radius: found '-0.0125', expected a positive number");
  EXPECT_EQ(complaint_after("2 0.1 0.2 0.1 0.0125", "2 0.1 0.2 0.1 0"),
            "tubes.txt:3: radius: found '0', expected a positive number");
}

TEST(Configuration, NamesARadiusUnlikeTheTubesFirst) {
  EXPECT_EQ(complaint_after("4 0.1 0 0.1 0.0125", "4 0.1 0 0.1 0.0126"),
            "tubes.txt:5: radius: found 0.0126, expected 0.0125, the radius of tube 1");
  EXPECT_EQ(complaint_after("e_1_2 1 2 1 0.01", "e_1_2 1 2 1 0.02"),
            "tubes.txt:11: radius: found 0.02, expected 0.01, the radius of tube 2");
}

TEST(Configuration, NamesWhatIsNoFiniteNumber) {
  const std::string node = "4 0.1 0 0.1 0.0125";
  EXPECT_EQ(complaint_after(node, "4 nan 0 0.1 0.0125"),
            "tubes.txt:5: x: found 'nan', expected a finite number");
  EXPECT_EQ(complaint_after(node, "4 0.1 -inf 0.1 0.0125"),
            "tubes.txt:5: y: found '-inf', expected a finite number");
  EXPECT_EQ(complaint_after(node, "4 0.1 0 1e999 0.0125"),
            "tubes.txt:5: z: found '1e999', expected a finite number");
  EXPECT_EQ(complaint_after(node, "4 0,1 0 0.1 0.0125"),
            "tubes.txt:5: x: found '0,1', expected a finite number");
  EXPECT_EQ(complaint_after(node, "4 0x1p3 0 0.1 0.0125"),
            "tubes.txt:5: x: found '0x1p3', expected a finite number");
  EXPECT_EQ(complaint_after(node, "4.0 0.1 0 0.1 0.0125"),
            "tubes.txt:5: node id: found '4.0', expected a whole number from 1 to 2147483647");
  EXPECT_EQ(complaint_after("e_4_2 4 2 2 0.0125 0.1 0.1 0.1 0.707106781", "e_4_2 4 2 2 0.0125 0.1 0.1 0.1 w"),
            "tubes.txt:7: qw: found 'w', expected a finite number");
  EXPECT_EQ(complaint_after("0 0 0.2\n", "0 0 -0.2\n"),
            "tubes.txt:7: length: found '-0.2', expected a positive number");
  EXPECT_EQ(complaint_after("e_4_2 4 2 2", "e_4_2 4 2 0"),
            "tubes.txt:7: order: found '0', expected a whole number from 1 to 2147483647");
}

TEST(Configuration, CountsTheFieldsOfALine) {
  EXPECT_EQ(complaint_after("4 0.1 0 0.1 0.0125", "4 0.1 0 0.1"),
            "tubes.txt:5: node 3 of 3: found 4 fields from '4' on, expected 5 fields: id x y z radius");
  EXPECT_EQ(complaint_after("0 0 0.2\n", "0 0 0.2 9\n"),
            "tubes.txt:7: edge 2 of 2: found 14 fields from 'e_4_2' on, expected 13 fields: name n1 n2 order "
            "radius cx cy cz qw qx qy qz length");
  EXPECT_EQ(complaint_after("4 0.1 0 0.1 0.0125", ""),
            "tubes.txt:5: node 3 of 3: found an empty line, expected 5 fields: id x y z radius");
}

TEST(Configuration, NoticesTextAfterTheLastTube) {
  EXPECT_EQ(complaint(two_tubes + "\nand more\n"),
            "tubes.txt:13: found 'and', expected the end of the file after tube 2 of 2");
}

TEST(Configuration, NoticesEdgesThatAreNoTree) {
  EXPECT_EQ(complaint_after("e_1_4 1 4", "e_1_1 1 1"),
            "tubes.txt:6: n1 n2: found 1 1, which closes a loop, expected edges that form a tree");
  EXPECT_EQ(complaint_after("e_4_2 4 2 2 0.0125 0.1 0.1 0.1 0.707106781 -0.707106781 0 0 0.2",
                            "e_4_1 4 1 2 0.0125 0.05 0 0.1 0.707106781 0 -0.707106781 0 0.1"),
            "tubes.txt:7: n1 n2: found 4 1, which closes a loop, expected edges that form a tree")
      << "and node 2 is left alone";
}

TEST(Configuration, NoticesAnEdgeThatContradictsItsNodes) {
  EXPECT_EQ(
      complaint_after("0 0 0.15 1", "0 0 0.1502 1"),
      "tubes.txt:11: cx cy cz: found (0, 0, 0.1502), expected the midpoint of nodes 1 and 2, (0, 0, 0.15)");
  EXPECT_EQ(complaint_after("0 0 0 0.3\n", "0 0 0 0.3002\n"),
            "tubes.txt:11: length: found 0.3002, expected the distance of nodes 1 and 2, 0.3");
  EXPECT_EQ(complaint_after("0.15 1 0 0 0", "0.15 0.99995 0.01 0 0"),
            "tubes.txt:11: qw qx qy qz: found a rotation of +z onto (0, -0.019999, 0.9998), expected the "
            "direction from node 1 to node 2, (0, 0, 1)");
  EXPECT_EQ(complaint_after("0.15 1 0 0 0", "0.15 0 1 0 0"),
            "tubes.txt:11: qw qx qy qz: found a rotation of +z onto (0, 0, -1), expected the direction from "
            "node 1 to node 2, (0, 0, 1)");
  EXPECT_EQ(complaint_after("0.15 1 0 0 0", "0.15 1.001 0 0 0"),
            "tubes.txt:11: qw qx qy qz: found a quaternion of norm 1.001, expected a unit quaternion");
  EXPECT_EQ(complaint_after("0.15 1 0 0 0", "0.15 0 0 0 0"),
            "tubes.txt:11: qw qx qy qz: found a quaternion of norm 0, expected a unit quaternion");
}

TEST(Configuration, ForgivesWhatRoundingMayDo) {
  EXPECT_EQ(complaint_after("0 0 0.15 1", "0 0 0.15005 1"), "none");
  EXPECT_EQ(complaint_after("0 0 0 0.3\n", "0 0 0 0.30005\n"), "none");
  EXPECT_EQ(complaint_after("0.15 1 0 0 0", "0.15 0.999995 0.003 0 0"), "none");
}

TEST(Configuration, KeepsItsMessagesOnOneShortLine) {
  EXPECT_EQ(
      complaint("one\x1b[2J" + std::string(1000, 'x') + "\n"),
      "tubes.txt:1: number of tubes: found 'one\\x1b[2Jxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx…', expected a whole "
      "number from 0 to 2147483647");
}

TEST(Configuration, OfAnEndlessLineIsAnError) {
  std::ifstream zeros("/dev/zero", std::ios::binary);
  EXPECT_THAT(test::complaint([&] { read_configuration(zeros, "zeros"); }),
              HasSubstr("zeros:1: line longer than 65535 bytes"));
}

}  // namespace
}  // namespace tanglebin
