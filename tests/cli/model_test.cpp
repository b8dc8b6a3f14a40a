#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tanglebin/io/configuration.hpp"
#include "tanglebin/io/pcd.hpp"
#include "tanglebin/io/ply.hpp"
#include "tanglebin/io/read_cloud.hpp"
#include "tanglebin/scan/scan_output.hpp"
#include "tanglebin/score/score.hpp"
#include "tests/model/scene/scanned.hpp"
#include "tests/support/program.hpp"

namespace tanglebin {
namespace {

using test::ProgramResult;
using test::run_program;
using testing::ElementsAre;
using testing::HasSubstr;

/// Two tubes that cross, scanned.
class ModelCommand : public testing::Test {
protected:
  ModelCommand() {
    write("scan.ply", ply_of(scan_));
    std::ostringstream text;
    write_configuration(text, tubes_);
    write("truth.txt", text.str());
  }

  static std::string ply_of(const PointCloud& cloud) {
    std::ostringstream out;
    write_ply(out, cloud);
    return out.str();
  }
  std::string path(const std::string& name) const { return (directory_ / name).string(); }
  void write(const std::string& name, const std::string& bytes) const {
    test::write_bytes(directory_ / name, bytes);
  }
  ProgramResult model(const std::string& cloud, const std::string& options) const {
    return run_program("model " + path(cloud) + " --out " + path("labelled.ply") + " " + options);
  }

  std::vector<Tube> tubes_ = {
      test::chain(1, 0.0125, {{-0.2, 0, 0.0125}, {0, 0.02, 0.0125}, {0.2, 0, 0.0125}}),
      test::chain(2, 0.0125, {{0.03, -0.15, 0.0125}, {0.03, 0, 0.06}, {0.03, 0.15, 0.0125}})};
  PointCloud scan_ = test::scanned(tubes_);
  test::TemporaryDirectory directory_;
};

TEST_F(ModelCommand, WritesThePointsWithLabelsAndTheTubes) {
  const ProgramResult run = model("scan.ply", "--downsample 0.5 --modelled-tubes " + path("tubes.txt"));
  ASSERT_EQ(run.status, 0) << run.err;
  for (const char* step : {"filter", "vote", "fragment", "join", "fit", "label"})
    EXPECT_THAT(run.out, HasSubstr(step));
  const PointCloud labelled = read_cloud(directory_ / "labelled.ply");
  EXPECT_EQ(labelled.points, scan_.points);
  EXPECT_EQ(read_configuration(directory_ / "tubes.txt").size(), 2U);

  const ProgramResult score =
      run_program("score --json --truth " + path("scan.ply") + " --labelled " + path("labelled.ply") +
                  " --true-tubes " + path("truth.txt") + " --modelled-tubes " + path("tubes.txt"));
  ASSERT_EQ(score.status, 0) << score.err;
  const auto json = nlohmann::json::parse(score.out);
  EXPECT_GT(json.at("micro_recall"), 0.98);
  EXPECT_LT(json.at("centre_line_error"), 0.001);
}

TEST_F(ModelCommand, PrintsItsStepsAsJson) {
  const ProgramResult run = model("scan.ply", "--json");
  ASSERT_EQ(run.status, 0) << run.err;
  const auto json = nlohmann::json::parse(run.out);
  EXPECT_EQ(json.at("points"), scan_.points.size());
  EXPECT_EQ(json.at("tubes"), 2);
  std::vector<std::string> names;
  for (const auto& step : json.at("steps")) names.push_back(step.at("name"));
  EXPECT_THAT(names, ElementsAre("filter", "vote", "fragment", "join", "fit", "label"));
}

TEST_F(ModelCommand, ReadsAPipeAndWritesOne) {
  const ProgramResult run = run_program("model - --out -", ply_of(scan_));
  ASSERT_EQ(run.status, 0) << run.err;
  std::istringstream in(run.out);
  EXPECT_EQ(read_cloud(in, "output").points, scan_.points);
}

TEST_F(ModelCommand, PrintsNothingBesideTubesOnStandardOutput) {
  const ProgramResult run = model("scan.ply", "--modelled-tubes -");
  ASSERT_EQ(run.status, 0) << run.err;
  std::istringstream in(run.out);
  EXPECT_EQ(read_configuration(in, "output").size(), 2U);
}

TEST_F(ModelCommand, KeepsAnOrganizedCloudWithItsHoles) {
  const KnownScene scene = test::paper_scene();
  const PointCloud organized =
      organized_cloud_from_scan(scan(tubes_, scene.support.bin, scene.camera), CloudOf::tubes_and_bin, 2);
  write("scan.pcd", [&] {
    std::ostringstream pcd;
    write_pcd(pcd, organized);
    return pcd.str();
  }());
  for (const std::string out : {"labelled.ply", "labelled.pcd"}) {
    ASSERT_EQ(run_program("model " + path("scan.pcd") + " --out " + path(out)).status, 0);
    const PointCloud labelled = read_cloud(directory_ / out);
    EXPECT_EQ(labelled.width, organized.width);
    EXPECT_EQ(labelled.height, organized.height);
    for (std::size_t i = 0; i < organized.points.size(); ++i) {
      const bool is_there = organized.points[i].allFinite();
      ASSERT_EQ(labelled.points[i].allFinite(), is_there) << i;
      ASSERT_TRUE(is_there || labelled.labels[i] == null_label) << i;
    }
  }
}

TEST_F(ModelCommand, KeepsWhatTheScannerMeasuredAndItsColours) {
  PointCloud measured = scan_;
  measured.labels.clear();
  for (std::size_t i = 0; i < measured.points.size(); ++i) {
    measured.colors[i] = {static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(i / 256), 99};
    measured.intensities.push_back(static_cast<float>(i));
    measured.normals.emplace_back(0, 0, 1);
  }
  write("measured.ply", ply_of(measured));
  ASSERT_EQ(model("measured.ply", "").status, 0);
  const PointCloud labelled = read_cloud(directory_ / "labelled.ply");
  EXPECT_EQ(labelled.colors, measured.colors);
  EXPECT_EQ(labelled.intensities, measured.intensities);
  EXPECT_EQ(labelled.normals, measured.normals);
  EXPECT_GT(score(scan_.labels, labelled.labels).micro_recall, 0.98);
}

TEST_F(ModelCommand, DrawsWhatEachStepLeft) {
  const std::map<std::string, std::vector<std::string>> pictures_of = {
      {"paper", {"1-filtered", "2-segmented", "3-fitted", "4-joined", "5-labelled"}},
      {"axis", {"1-filtered", "2-votes", "3-joined", "4-labelled"}}};
  for (const auto& [method, names] : pictures_of) {
    ASSERT_EQ(
        model("scan.ply", "--method " + method + " --downsample 0.3 --debug-dir " + path(method)).status, 0);
    for (const std::string& name : names) {
      const std::string png = test::bytes_of(directory_ / method / (name + ".png"));
      EXPECT_TRUE(png.starts_with("\x89PNG")) << method << " " << name;
    }
  }
}

TEST_F(ModelCommand, OfAnEmptyCloudWritesAnEmptyOne) {
  write("empty.ply", ply_of({}));
  const ProgramResult run =
      model("empty.ply", "--modelled-tubes " + path("tubes.txt") + " --debug-dir " + path("steps"));
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_TRUE(read_cloud(directory_ / "labelled.ply").points.empty());
  EXPECT_EQ(test::bytes_of(directory_ / "tubes.txt"), "0\n");
}

TEST_F(ModelCommand, EstimatesTheRadius) {
  const ProgramResult run = model("scan.ply", "--radius auto --json");
  ASSERT_EQ(run.status, 0) << run.err;
  const auto json = nlohmann::json::parse(run.out);
  EXPECT_NEAR(json.at("radii").at(0), 0.0125, 0.02 * 0.0125);
  EXPECT_EQ(json.at("tubes"), 2);
  EXPECT_THAT(model("scan.ply", "--radius auto").out, HasSubstr("radius    0.012"));

  write("empty.ply", ply_of(test::scanned({})));
  const ProgramResult nothing = model("empty.ply", "--radius auto");
  EXPECT_EQ(nothing.status, 2);
  EXPECT_THAT(nothing.err, HasSubstr("radius: the cloud shows too little of a tube"));
}

TEST_F(ModelCommand, TakesTubesOfSeveralRadiiAndLengths) {
  const std::vector<Tube> tubes = {test::chain(1, 0.008, {{-0.2, 0.1, 0.008}, {0.1, 0.1, 0.008}}),
                                   test::chain(2, 0.0125, {{-0.2, -0.1, 0.0125}, {0.2, -0.1, 0.0125}})};
  const PointCloud cloud = test::scanned(tubes);
  write("mixed.ply", ply_of(cloud));
  const ProgramResult run = model(
      "mixed.ply", "--radius 0.008,0.0125 --length 0.3,0.4 --json --modelled-tubes " + path("tubes.txt"));
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(nlohmann::json::parse(run.out).at("radii"), nlohmann::json::parse("[0.008, 0.0125]"));
  const std::vector<Tube> found = read_configuration(directory_ / "tubes.txt");
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].radius, 0.008);
  EXPECT_EQ(found[1].radius, 0.0125);
  EXPECT_GT(score(cloud.labels, read_cloud(directory_ / "labelled.ply").labels).micro_recall, 0.999);
}

TEST_F(ModelCommand, RefusesWhatItCannotModel) {
  PointCloud millimetres = scan_;
  for (Eigen::Vector3f& point : millimetres.points) point *= 1000;
  write("mm.ply", ply_of(millimetres));
  const std::vector<std::pair<ProgramResult, std::string>> refusals = {
      {model("mm.ply", ""), "millimetres?"},
      {model("scan.ply", "--radius 8"), "radius: found 8 m, expected 0.0001 to 1 m; for 8 mm write 0.008"},
      {model("scan.ply", "--length 80"), "length: found 80 m, expected at most 6.92 m"},
      {model("scan.ply", "--downsample 0.1,0.2"), "--downsample: found 2 ratios, expected one"},
      {model("scan.ply", "--modelled-tubes tubes.ply"),
       "--modelled-tubes: found 'tubes.ply', expected a name that ends in .txt"},
      {run_program("model " + path("scan.ply") + " --out labelled.xyz"),
       "--out: found 'labelled.xyz', expected a name that ends in .ply or .pcd"},
      {model("scan.ply", "--method magic"), "method: found 'magic', expected paper, axis"},
      {model("scan.ply", "--downsample 0"),
       "--downsample: found '0', expected a ratio above 0 and at most 1"},
      {model("scan.ply", "--radius -1"), "--radius: found '-1', expected a positive number"},
      {model("scan.ply", "--radius 0.01,"), "--radius: found '', expected a positive number"},
      {model("scan.ply", "--radius 0.01,0.01"), "radius: found 0.01 m for two kinds"},
      {model("scan.ply", "--radius 0.01,0.02,0.03 --length 0.4,0.5"),
       "--length: found 2 lengths, expected one, or one for each radius: 3"},
      {model("scan.ply", "--tree 1-2:0.3,1-3"),
       "--tree: found '1-3', expected a segment with its length in metres, such as 1-2:0.3"},
      {model("scan.ply", "--tree 1-2:0.3,2-1:0.1"), "--tree: found a segment to node 1, which closes a loop"},
      {model("scan.ply", "--tree 1-2:0.3 --tree 1-2:0.4"),
       "--tree: found 2 trees, expected one, or one for each radius: 1"},
      {model("scan.ply", "--radius 0.01,0.02 --method paper"),
       "method: the paper's method handles a single radius"},
      {model("scan.ply", "--bin bucket"), "bucket"},
      {model("nowhere.ply", ""), "nowhere.ply"},
  };
  for (const auto& [run, message] : refusals) {
    EXPECT_EQ(run.status, 2) << message;
    EXPECT_THAT(run.err, HasSubstr(message));
  }
  EXPECT_FALSE(std::filesystem::exists(directory_ / "labelled.ply"));
  EXPECT_EQ(run_program("model " + path("scan.ply")).status, 64);
}

}  // namespace
}  // namespace tanglebin
