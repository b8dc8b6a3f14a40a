#include "tests/dataset/checker.hpp"

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "tanglebin/generate/generate.hpp"
#include "tanglebin/io/configuration.hpp"
#include "tanglebin/settle/overlap.hpp"
#include "tests/geometry/example_tubes.hpp"
#include "tests/support/temporary_directory.hpp"

namespace checker {
namespace {

using Eigen::Vector3d;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

using Points = std::vector<Vector3d>;

constexpr double radius = 0.0125;
constexpr CheckerBin paper_bin = {.length = 0.55, .width = 0.37};
constexpr CheckerTube set_a = {.bend_min_deg = 0, .bend_max_deg = 30};

// A tube in the text format: nodes 1, 4, 5, … 2 along the points.
std::string tube_text(int id, const Points& points, double tube_radius = radius) {
  const auto node = [&](std::size_t i) {
    if (i == 0) return std::size_t{1};
    return i + 1 == points.size() ? 2 : i + 3;
  };
  std::string text = fmt::format("{} {} {}\n", id, points.size(), points.size() - 1);
  for (std::size_t i = points.size(); i-- > 0;) {
    const Vector3d& p = points[i];
    text += fmt::format("{} {} {} {} {}\n", node(i), p.x(), p.y(), p.z(), tube_radius);
  }
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Vector3d along = points[i] - points[i - 1];
    const Vector3d c = (points[i] + points[i - 1]) / 2;
    const auto q = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), along);
    text +=
        fmt::format("e_{}_{} {} {} {} {} {} {} {} {} {} {} {} {}\n", node(i - 1), node(i), node(i - 1),
                    node(i), i, tube_radius, c.x(), c.y(), c.z(), q.w(), q.x(), q.y(), q.z(), along.norm());
  }
  return text;
}

std::string file_text(const std::vector<Points>& tubes) {
  std::string text = fmt::format("{}\n", tubes.size());
  int id = 0;
  for (const Points& points : tubes) text += tube_text(++id, points);
  return text;
}

std::vector<std::string> faults_of_text(const std::string& text, int tubes,
                                        const CheckerBin& bin = paper_bin) {
  const tanglebin::test::TemporaryDirectory directory;
  const auto file = directory / "tubes.txt";
  tanglebin::test::write_bytes(file, text);
  return faults_of(file.string(), bin, set_a, tubes);
}

std::vector<std::string> faults_of_tubes(const std::vector<Points>& tubes) {
  return faults_of_text(file_text(tubes), static_cast<int>(tubes.size()));
}

// Cylinders one after the other from a point, by length and heading in a horizontal plane.
struct Part {
  double length;
  double heading_deg;
};

Points chain(Vector3d from, const std::vector<Part>& parts) {
  Points points = {from};
  for (const auto& [length, heading_deg] : parts) {
    const double heading = heading_deg * std::numbers::pi / 180;
    points.emplace_back(points.back() + length * Vector3d(std::cos(heading), std::sin(heading), 0));
  }
  return points;
}

// Half a metre along x in five cylinders, its middle at the point.
Points straight(const Vector3d& middle) {
  return chain(middle - Vector3d(0.25, 0, 0), std::vector<Part>(5, {0.1, 0}));
}

const Points good = straight({0, 0, radius});

TEST(Checker, GoodFilesHaveNoFaults) {
  EXPECT_THAT(faults_of_tubes({}), IsEmpty());
  EXPECT_THAT(faults_of_tubes({good}), IsEmpty());
  const Points bent = chain({-0.24, -0.1, 0.05}, {{0.2, 0}, {0.02, 30}, {0.08, 20}, {0.1, -5}, {0.1, 25}});
  EXPECT_THAT(faults_of_tubes({good, straight({0, 0.025, radius}), bent}), IsEmpty());
}

TEST(Checker, AFileThatIsNoConfigurationIsAFault) {
  EXPECT_THAT(faults_of("/nowhere/1.txt", paper_bin, set_a, 1),
              ElementsAre("/nowhere/1.txt: cannot be opened"));
  EXPECT_THAT(faults_of_text("", 0), ElementsAre(HasSubstr("no number of tubes")));
  EXPECT_THAT(faults_of_text("tubes", 0), ElementsAre(HasSubstr("no number of tubes")));
  EXPECT_THAT(faults_of_text("2\n" + tube_text(1, good), 2), ElementsAre(HasSubstr("no tube")));
  EXPECT_THAT(faults_of_text("1\n1 0 0\n", 1), ElementsAre(HasSubstr("no cylinders")));
  EXPECT_THAT(faults_of_text("1\n1 1 1\n1 0 0 0 0.0125\ne_1_2 1 2 1", 1),
              ElementsAre(HasSubstr("no node 1 or 2")));
  EXPECT_THAT(faults_of_text("1\n1 2 1\n1 0 nan 0 0.0125", 1),
              ElementsAre(HasSubstr("no position of a node")));
  std::string text = file_text({good});
  text.erase(text.rfind(' '));
  EXPECT_THAT(faults_of_text(text, 1), ElementsAre(HasSubstr("no length of a cylinder")));
  EXPECT_THAT(faults_of_text(file_text({good}) + "9", 1), ElementsAre(HasSubstr("more than its tubes: 9")));
}

TEST(Checker, AnotherNumberOfTubesIsAFault) {
  EXPECT_THAT(faults_of_text(file_text({good}), 2), ElementsAre("file: 1 tubes, not 2"));
  EXPECT_THAT(faults_of_text(file_text({}), 5), ElementsAre("file: 0 tubes, not 5"));
}

TEST(Checker, AnotherRadiusIsAFaultOfEveryNodeAndCylinder) {
  EXPECT_THAT(faults_of_text("1\n" + tube_text(1, good, 0.012), 1),
              ::testing::AllOf(::testing::SizeIs(6 + 5),
                               ::testing::Each(std::string("tube 1: a radius of 0.012, not 0.0125"))));
}

TEST(Checker, ATubeTooLongOrTooShortIsAFault) {
  const auto of_length = [](double last) {
    return faults_of_tubes({chain({-0.25, 0, radius}, {{0.2, 0}, {0.2, 0}, {last, 0}})});
  };
  EXPECT_THAT(of_length(0.1 + 0.9e-6), IsEmpty());
  EXPECT_THAT(of_length(0.1 + 1.1e-6), ElementsAre("tube 1: 0.5000011 m long, not 0.5"));
  EXPECT_THAT(of_length(0.1 - 1.1e-6), ElementsAre("tube 1: 0.4999989 m long, not 0.5"));
}

TEST(Checker, ACylinderTooShortIsAFault) {
  EXPECT_THAT(faults_of_tubes({chain({-0.25, 0, radius}, {{0.2, 0}, {0.0199, 0}, {0.2801, 0}})}),
              ElementsAre("tube 1: cylinder 2 is 0.019900 m long, less than 0.02"));
}

TEST(Checker, ABendOutOfRangeIsAFault) {
  const std::vector<Part> parts = {{0.3, 0}, {0.1, 10}, {0.1, 41}};
  const Points tube = chain({-0.25, 0, radius}, parts);
  EXPECT_THAT(faults_of_tubes({tube}), ElementsAre("tube 1: bend 2 is 31.0000°, not 0 to 30°"));

  const tanglebin::test::TemporaryDirectory directory;
  const auto file = directory / "tubes.txt";
  tanglebin::test::write_bytes(file, file_text({tube}));
  const CheckerTube bent = {.bend_min_deg = 15, .bend_max_deg = 45};
  EXPECT_THAT(faults_of(file.string(), paper_bin, bent, 1),
              ElementsAre("tube 1: bend 1 is 10.0000°, not 15 to 45°"));
}

// The good file after one change of its text.
std::vector<std::string> faults_after(const std::string& old_text, const std::string& new_text) {
  std::string text = file_text({good});
  const std::size_t place = text.find(old_text);
  EXPECT_NE(place, std::string::npos) << "the example has no " << old_text;
  return faults_of_text(text.replace(place, old_text.size(), new_text), 1);
}

TEST(Checker, CylindersThatAreNoChainFromNode1ToNode2AreAFault) {
  EXPECT_THAT(faults_after("e_4_5 4 5 2", "e_4_5 4 5 6"),
              Contains("tube 1: cylinder 3 does not go on from node 4"));
  EXPECT_THAT(faults_after("e_1_4 1 4 1", "e_1_4 4 1 1"),
              Contains("tube 1: cylinder 1 does not go on from node 1"));
  EXPECT_THAT(faults_after("e_7_2 7 2 5", "e_7_2 7 6 5"), Contains("tube 1: ends at node 6, not 2"));
}

TEST(Checker, ACylinderThatContradictsItsNodesIsAFault) {
  EXPECT_THAT(faults_after("-0.2 0 0.0125 0.7", "-0.2 0.00001 0.0125 0.7"),
              ElementsAre("tube 1: cylinder 1 contradicts its nodes"));
  EXPECT_THAT(faults_after("0 0.7071067811865475", "0 -0.7071067811865475"),
              Contains("tube 1: cylinder 1 contradicts its nodes"));
  EXPECT_THAT(faults_after(" 0.1\n", " 0.10001\n"), Contains(HasSubstr("contradicts its nodes")));
}

TEST(Checker, MoreThanAThirdOfAMillimetreInTheFloorIsAFault) {
  EXPECT_THAT(faults_of_tubes({straight({0, 0, radius - 0.00029})}), IsEmpty());
  EXPECT_THAT(faults_of_tubes({straight({0, 0, radius - 0.00031})}),
              ElementsAre("tube 1: 0.310 mm in the floor"));
  EXPECT_THAT(faults_of_tubes({straight({0, 0, -1})}), ElementsAre("tube 1: 1012.500 mm in the floor"));
}

TEST(Checker, EveryWallIsAFaultWhereItIsEnteredByMoreThan300Micrometres) {
  const double gap_x = 0.55 / 2 - 0.25 - radius;
  const double gap_y = 0.37 / 2 - radius;
  EXPECT_THAT(faults_of_tubes({straight({gap_x + 0.00029, 0, 0.1})}), IsEmpty());
  EXPECT_THAT(faults_of_tubes({straight({gap_x + 0.00031, 0, 0.1})}),
              ElementsAre("tube 1: 0.310 mm in the wall at +x"));
  EXPECT_THAT(faults_of_tubes({straight({-gap_x - 0.00031, 0, 0.1})}),
              ElementsAre("tube 1: 0.310 mm in the wall at -x"));
  EXPECT_THAT(faults_of_tubes({straight({0, gap_y + 0.00031, 0.1})}),
              ElementsAre("tube 1: 0.310 mm in the wall at +y"));
  EXPECT_THAT(faults_of_tubes({straight({0, -gap_y - 0.00031, 0.1})}),
              ElementsAre("tube 1: 0.310 mm in the wall at -y"));
  // One whose centre line is inside the wall is as deep as a tube can be.
  EXPECT_THAT(faults_of_tubes({straight({0.04, 0, 0.1})}),
              ElementsAre("tube 1: 12.500 mm in the wall at +x"));
}

// Steeply over the rim, so deep in the edge of the wall at +x.
Points over_the_rim(double depth) {
  const Vector3d along = Vector3d(1, 0, 1).normalized();
  const Vector3d up = Vector3d(-1, 0, 1).normalized();
  const Vector3d start = Vector3d(0.275, 0, 0.2) + (radius - depth) * up - 0.26 * along;
  return {start, start + 0.1 * along, start + 0.5 * along};
}

TEST(Checker, TheRimsEdgeIsPartOfTheWall) {
  EXPECT_THAT(faults_of_tubes({over_the_rim(0.00029)}), IsEmpty());
  EXPECT_THAT(faults_of_tubes({over_the_rim(0.00031)}), ElementsAre("tube 1: 0.310 mm in the wall at +x"));
}

TEST(Checker, ATubeOverTheRimIsClearOfTheWallsButItsCentreMayNotBe) {
  EXPECT_THAT(faults_of_tubes({straight({0.27, 0, 0.2125})}), IsEmpty());
  EXPECT_THAT(faults_of_tubes({straight({0.28, 0, 0.2125})}),
              ElementsAre("tube 1: its centre, (0.2800, 0.0000), is not between the walls"));
  EXPECT_THAT(faults_of_tubes({straight({0.01, -0.6, 0.1})}),
              ElementsAre("tube 1: its centre, (0.0100, -0.6000), is not between the walls"));
}

TEST(Checker, TheCentreIsThatOfTheLengthNotOfTheNodes) {
  // Most of its nodes are out, most of its length is in.
  const Points tube =
      chain({-0.1, 0, 0.22}, {{0.4, 0}, {0.02, 0}, {0.02, 0}, {0.02, 0}, {0.02, 0}, {0.02, 0}});
  EXPECT_THAT(faults_of_tubes({tube}), IsEmpty());
}

TEST(Checker, TubesThatOverlapByMoreThanAThirdOfAMillimetreAreAFault) {
  // Side by side.
  EXPECT_THAT(faults_of_tubes({good, straight({0, 0.02471, radius})}), IsEmpty());
  EXPECT_THAT(faults_of_tubes({good, straight({0, 0.02469, radius})}),
              ElementsAre("tubes 1 and 2: overlap by 0.310 mm"));
  // Crossing, in the middle of cylinders.
  const double slope = 30;
  const auto across = [&](double z) { return chain({-0.23, -0.11, z}, std::vector<Part>(5, {0.1, slope})); };
  EXPECT_THAT(faults_of_tubes({good, across(radius + 0.02471)}), IsEmpty());
  EXPECT_THAT(faults_of_tubes({good, across(radius + 0.02469)}),
              ElementsAre("tubes 1 and 2: overlap by 0.310 mm"));
  EXPECT_THAT(faults_of_tubes({good, across(radius)}), ElementsAre("tubes 1 and 2: overlap by 25.000 mm"));
}

TEST(Checker, TubesThatMeetEndToEndAreAFaultToo) {
  const CheckerBin long_bin = {.length = 2, .width = 0.37};
  const auto faults = [&](double gap) {
    return faults_of_text(
        file_text({straight({-0.25 - gap / 2, 0, radius}), straight({0.25 + gap / 2, 0, radius})}), 2,
        long_bin);
  };
  EXPECT_THAT(faults(0.02471), IsEmpty());
  EXPECT_THAT(faults(0.02469), ElementsAre("tubes 1 and 2: overlap by 0.310 mm"));
}

TEST(Checker, EveryPairIsCheckedAndEveryFaultNamed) {
  const Points low = straight({0, 0.1, 0.012});
  EXPECT_THAT(
      faults_of_tubes({good, straight({0, -0.1, radius}), straight({0, 0.02, radius}), low,
                       straight({0, -0.08, radius})}),
      ::testing::UnorderedElementsAre("tubes 1 and 3: overlap by 5.000 mm",
                                      "tubes 2 and 5: overlap by 5.000 mm", "tube 4: 0.500 mm in the floor"));
}

// What the file says of two tubes' overlap, mm; 0 where it finds none.
double overlap_found(const std::vector<std::string>& faults) {
  const std::string begin = "tubes 1 and 2: overlap by ";
  for (const std::string& fault : faults) {
    if (fault.starts_with(begin)) return std::stod(fault.substr(begin.size()));
  }
  return 0;
}

TEST(Checker, AgreesWithTheLibraryOnRandomPairs) {
  tanglebin::Rng rng(1);
  const auto random_tube = [&](int id) {
    tanglebin::Tube tube = draw_tube(rng, tanglebin::test::chain_spec(30), id);
    const auto shift = [&] { return tanglebin::uniform_real(rng, -0.04, 0.04); };
    transform(tube, Eigen::Isometry3d(Eigen::Translation3d(shift(), shift(), shift())));
    return tube;
  };
  int overlapping = 0;
  for (int i = 0; i < 300; ++i) {
    const std::vector<tanglebin::Tube> tubes = {random_tube(1), random_tube(2)};
    std::ostringstream text;
    write_configuration(text, tubes);
    const double library = 1e3 * tanglebin::largest_tube_overlap(tubes);
    const double found = overlap_found(faults_of_text(text.str(), 2));
    EXPECT_NEAR(found, library > 0.3 ? library : 0, 0.0006) << "pair " << i;
    if (found > 0) ++overlapping;
  }
  EXPECT_GT(overlapping, 30);
  EXPECT_LT(overlapping, 270);
}

TEST(Checker, FindsTheOverlapThatAPublishedFileIsKnownFor) {
  const std::filesystem::path file = std::filesystem::path(TANGLEBIN_PUBLISHED) / "B15_13.txt";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "the published data is not in " << TANGLEBIN_PUBLISHED;
  const std::vector<std::string> faults =
      faults_of(file.string(), {.length = 0.80, .width = 0.60}, {0, 45}, 15);
  EXPECT_THAT(faults, Contains(::testing::StartsWith("tubes 13 and 14: overlap by 15.")));
}

}  // namespace
}  // namespace checker
