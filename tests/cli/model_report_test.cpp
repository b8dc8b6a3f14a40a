#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "tanglebin/io/ply.hpp"
#include "tests/model/scene/scanned.hpp"
#include "tests/support/program.hpp"

namespace tanglebin {
namespace {

using test::ProgramResult;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// Two tubes that cross, scanned.
class ModelReport : public testing::Test {
protected:
  std::string path(const std::string& name) const { return (directory_ / name).string(); }
  ProgramResult model(const PointCloud& cloud, const std::string& options) const {
    std::ostringstream ply;
    write_ply(ply, cloud);
    test::write_bytes(directory_ / "scan.ply", ply.str());
    return test::run_program("model " + path("scan.ply") +
                             " --scene " TANGLEBIN_SOURCE "/scenes/paper.toml --out " + path("labelled.ply") +
                             " " + options);
  }

  PointCloud scan_ = test::scanned(
      {test::straight_tube(1, 0), test::chain(2, test::radius, {{0, -0.15, 0.05}, {0.1, 0.15, 0.05}})});
  test::TemporaryDirectory directory_;
};

TEST_F(ModelReport, PrintsALineForEachTube) {
  const ProgramResult run = model(scan_, "");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, AllOf(HasSubstr("tube confidence"), HasSubstr("\n   1 "), HasSubstr("\n   2 ")));
  EXPECT_THAT(run.out, HasSubstr(std::to_string(scan_.points.size()) + " points: "));
}

TEST_F(ModelReport, NamesWhatThePointsMissed) {
  for (int i = 0; i < 3; ++i) {
    scan_.points.emplace_back(5, 5, 0);
    scan_.points.emplace_back(0, 0, 0.8F);
    scan_.labels.insert(scan_.labels.end(), 2, -1);
    scan_.colors.insert(scan_.colors.end(), 2, {0, 0, 0});
  }
  scan_.width = scan_.points.size();
  const ProgramResult run = model(scan_, "");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, AllOf(HasSubstr(" 3 too far away"), HasSubstr(" 3 outside of the camera's image")));
}

TEST_F(ModelReport, WritesTheTubesAsJsonWithHowSureTheyAre) {
  ASSERT_EQ(model(scan_, "--modelled-tubes " + path("tubes.json")).status, 0);
  const auto json = nlohmann::json::parse(test::bytes_of(directory_ / "tubes.json"));
  EXPECT_EQ(json.at("format"), 1);
  EXPECT_EQ(json.at("frame"), "world");
  EXPECT_EQ(json.at("unit"), "m");
  EXPECT_EQ(json.at("usable"), true);
  EXPECT_EQ(json.at("points").at("all"), scan_.points.size());
  ASSERT_EQ(json.at("tubes").size(), 2U);
  int joins = 0;
  for (const auto& tube : json.at("tubes")) {
    EXPECT_EQ(tube.at("radius"), test::radius);
    EXPECT_EQ(tube.at("ends"), "round");
    EXPECT_EQ(tube.at("edges").size() + 1, tube.at("nodes").size());
    EXPECT_LT(tube.at("residual"), 0.001);
    EXPECT_GT(tube.at("confidence"), 0);
    EXPECT_LE(tube.at("confidence"), 1);
    for (const auto& join : tube.at("joins")) {
      ++joins;
      EXPECT_GT(join.at("log_odds"), 0);
    }
  }
  EXPECT_EQ(joins, 1);
}

TEST_F(ModelReport, SaysTheSameInItsOwnJson) {
  const ProgramResult run = model(scan_, "--json --modelled-tubes " + path("tubes.json"));
  const auto printed = nlohmann::json::parse(run.out);
  const auto written = nlohmann::json::parse(test::bytes_of(directory_ / "tubes.json"));
  EXPECT_EQ(printed.at("found"), written.at("tubes"));
  EXPECT_EQ(printed.at("counts"), written.at("points"));
  EXPECT_EQ(printed.at("findings"), written.at("findings"));
  EXPECT_EQ(printed.at("tubes"), 2);
}

// As docs/formats.md says: who draws the centre line follows the edges.
TEST_F(ModelReport, HasTheEdgesInOrderFromOneEndToTheOther) {
  for (const std::string method : {"axis", "paper"}) {
    ASSERT_EQ(model(scan_, "--method " + method + " --modelled-tubes " + path("tubes.json")).status, 0);
    const auto written = nlohmann::json::parse(test::bytes_of(directory_ / "tubes.json"));
    for (const auto& tube : written.at("tubes")) {
      const auto& edges = tube.at("edges");
      EXPECT_EQ(edges.size() + 1, tube.at("nodes").size());
      for (std::size_t i = 1; i < edges.size(); ++i) EXPECT_EQ(edges[i - 1][1], edges[i][0]) << method;
    }
  }
}

TEST_F(ModelReport, SaysWhichLengthItFound) {
  const PointCloud three =
      test::scanned({test::straight_tube(1, -0.1), test::straight_tube(2, 0), test::straight_tube(3, 0.1)});
  const std::string to_json = " --modelled-tubes " + path("tubes.json");
  const ProgramResult run = model(three, "--length unknown" + to_json);
  EXPECT_THAT(run.out, HasSubstr("\nthe length is estimated: 0."));
  const auto json = nlohmann::json::parse(test::bytes_of(directory_ / "tubes.json"));
  ASSERT_EQ(json.at("estimated_lengths").size(), 1U);
  EXPECT_EQ(json.at("estimated_lengths")[0].at("kind"), 0);
  EXPECT_NEAR(json.at("estimated_lengths")[0].at("length"), 0.5, 0.01);
  EXPECT_EQ(nlohmann::json::parse(model(three, "--length unknown --json").out).at("estimated_lengths"),
            json.at("estimated_lengths"));
  EXPECT_THAT(model(three, "").out, Not(HasSubstr("estimated")));
}

TEST_F(ModelReport, WritesTheSurfacesOfTheTubes) {
  ASSERT_EQ(model(scan_, "--mesh " + path("tubes.ply")).status, 0);
  EXPECT_THAT(test::bytes_of(directory_ / "tubes.ply"), HasSubstr("\nelement face "));
  ASSERT_EQ(model(scan_, "--mesh " + path("tubes.obj")).status, 0);
  EXPECT_THAT(test::bytes_of(directory_ / "tubes.obj"), HasSubstr("\no tube_2\n"));
  const ProgramResult refused = model(scan_, "--mesh tubes.stl");
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("--mesh: found 'tubes.stl', expected a name that ends in .ply or .obj"));
}

TEST_F(ModelReport, AScanThatDoesNotFitEndsWithItsOwnStatusAndWhatToTry) {
  PointCloud millimetres = scan_;
  for (Eigen::Vector3f& point : millimetres.points) point *= 1000;
  const ProgramResult run = model(millimetres, "--modelled-tubes " + path("tubes.json"));
  EXPECT_EQ(run.status, 6);
  EXPECT_THAT(run.err, AllOf(HasSubstr("scan.ply: "), HasSubstr("--unit mm")));
  EXPECT_EQ(nlohmann::json::parse(test::bytes_of(directory_ / "tubes.json")).at("usable"), false);
  EXPECT_TRUE(std::filesystem::exists(directory_ / "labelled.ply"));
}

TEST_F(ModelReport, AnEmptyBinEndsWithTheSameStatus) {
  const ProgramResult run = model(test::scanned({}), "");
  EXPECT_EQ(run.status, 6);
  EXPECT_THAT(run.err, HasSubstr("it looks empty"));
}

TEST_F(ModelReport, AWarningIsNoFailure) {
  const ProgramResult run = model(scan_, "--downsample 0.05");
  EXPECT_EQ(run.status, 0);
  EXPECT_THAT(run.err, HasSubstr("scan.ply: warning: only "));
}

}  // namespace
}  // namespace tanglebin
