#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "tanglebin/io/pcd.hpp"
#include "tanglebin/io/ply.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_directory.hpp"

namespace tanglebin {
namespace {

using test::ProgramResult;
using test::run_program;
using testing::HasSubstr;
using testing::StartsWith;

/// The worked example of the paper's Section 5 on disk: the truth as PLY, and the labelled cloud, which lacks
/// the null points and has the others backwards, as PCD.
class ScoreCommand : public testing::Test {
protected:
  ScoreCommand() {
    add(26, 1, 10);
    add(2, 1, 20);
    add(11, 1, -1);
    add(24, 2, 20);
    add(2, 2, 30);
    add(7, 2, -1);
    truth_.width = truth_.points.size();
    std::ranges::reverse(labelled_.points);
    std::ranges::reverse(labelled_.labels);
    labelled_.width = labelled_.points.size();
    std::ofstream truth_file(directory_ / "truth.ply", std::ios::binary);
    write_ply(truth_file, truth_);
    std::ofstream labelled_file(directory_ / "labelled.pcd", std::ios::binary);
    write_pcd(labelled_file, labelled_);
  }

  std::string path(const std::string& name) const { return (directory_ / name).string(); }

  void write(const std::string& name, const std::string& text) const {
    test::write_bytes(directory_ / name, text);
  }

  ProgramResult score(const std::string& truth, const std::string& labels,
                      const std::string& options = "") const {
    return run_program("score --truth " + path(truth) + " --labelled " + path(labels) + " " + options);
  }

  ProgramResult score_example(const std::string& options = "") const {
    return score("truth.ply", "labelled.pcd", options);
  }

private:
  void add(int points, std::int32_t tube, std::int32_t label) {
    for (int i = 0; i < points; ++i) {
      truth_.points.emplace_back(static_cast<float>(truth_.points.size()) / 1000, 0.25F, 0.0F);
      truth_.labels.push_back(tube);
      if (label < 0) continue;
      labelled_.points.push_back(truth_.points.back());
      labelled_.labels.push_back(label);
    }
  }

  test::TemporaryDirectory directory_;
  PointCloud truth_;
  PointCloud labelled_;
};

// The configuration of a straight tube along x.
std::string tube_from(double x, double y, double length) {
  return fmt::format(
      "1\n1 2 1\n1 {0} {1} 0 0.0125\n2 {2} {1} 0 0.0125\n"
      "e_1_2 1 2 1 0.0125 {3} {1} 0 0.70710678 0 0.70710678 0 {4}\n",
      x, y, x + length, x + length / 2, length);
}

std::string one_point(const std::string& coordinates, const std::string& label) {
  return "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
         "property int label\nend_header\n" +
         coordinates + " " + label + "\n";
}

TEST_F(ScoreCommand, PrintsTheWorkedExamplesMicroRecall) {
  const ProgramResult run = score_example();
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, StartsWith("micro-recall         0.694  50 of 72 points, 18 null\n"));
  EXPECT_THAT(run.out, testing::Not(HasSubstr("tube 1")));
}

TEST_F(ScoreCommand, PrintsJson) {
  const ProgramResult run = score_example("--json");
  ASSERT_EQ(run.status, 0) << run.err;
  const auto json = nlohmann::json::parse(run.out);
  EXPECT_EQ(json.at("micro_recall").get<double>(), 50.0 / 72.0);
  EXPECT_EQ(json.at("correct_points"), 50);
  EXPECT_EQ(json.at("points"), 72);
  EXPECT_EQ(json.at("null_points"), 18);
  EXPECT_EQ(json.at("tubes").at(0).at("assigned"), 10);
  EXPECT_EQ(json.at("tubes").at(1).at("assigned"), 20);
  EXPECT_EQ(json.at("tubes").at(1).at("correct_points"), 24);
  for (const char* key : {"mean_iou", "precision", "recall", "f1", "panoptic_quality", "adjusted_rand_index",
                          "correct", "over_segmented", "under_segmented", "missed", "noise"}) {
    EXPECT_TRUE(json.contains(key)) << key;
  }
  EXPECT_FALSE(json.contains("confusion"));
}

TEST_F(ScoreCommand, PrintsTheConfusionMatrixOnRequest) {
  const ProgramResult text = score_example("--confusion");
  EXPECT_THAT(text.out, HasSubstr("   label       10       20       30     null\n"
                                  "  tube 1       26        2        0       11\n"
                                  "  tube 2        0       24        2        7\n"));
  const auto json = nlohmann::json::parse(score_example("--json --confusion").out).at("confusion");
  EXPECT_EQ(json.at("tubes"), nlohmann::json({1, 2}));
  EXPECT_EQ(json.at("labels"), nlohmann::json({10, 20, 30, -1}));
  EXPECT_EQ(json.at("points"), nlohmann::json({{26, 2, 0, 11}, {0, 24, 2, 7}}));
}

// A cloud of n points in a row, each with a label of its own.
std::string each_its_own_label(int n) {
  std::string text = fmt::format(
      "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
      "property int label\nend_header\n",
      n);
  for (int i = 1; i <= n; ++i) text += fmt::format("{} 0 0 {}\n", i, i);
  return text;
}

TEST_F(ScoreCommand, RefusesAConfusionMatrixBeyondAllReason) {
  write("many.ply", each_its_own_label(3200));
  EXPECT_EQ(score("many.ply", "many.ply").status, 0);
  for (const char* options : {"--confusion", "--confusion --json"}) {
    const ProgramResult refused = score("many.ply", "many.ply", options);
    EXPECT_EQ(refused.status, 2);
    EXPECT_EQ(
        refused.err,
        "tanglebin: --confusion: found a matrix of 3200 tubes by 3201 labels, expected at most 10000000 "
        "cells\n");
    EXPECT_EQ(refused.out, "");
  }
}

TEST_F(ScoreCommand, WarnsOfTheTruthsOwnLabels) {
  const ProgramResult forgotten = score("truth.ply", "truth.ply", "--json");
  EXPECT_EQ(forgotten.status, 0);
  EXPECT_EQ(nlohmann::json::parse(forgotten.out).at("micro_recall"), 1.0);
  EXPECT_EQ(forgotten.err,
            "tanglebin: warning: " + path("truth.ply") +
                ": its labels are the truth's own at every point; are they the result to score?\n");
  EXPECT_EQ(score_example().err, "");
}

TEST_F(ScoreCommand, WarnsOfTheTruthsOwnLabelsOfADataset) {
  ASSERT_EQ(run_program("generate - --out " + path("dataset"),
                        "[scanner]\nwidth = 192\nheight = 120\n[[set]]\nname = \"A\"\ntubes = [1, 2]\n"
                        "[set.tube]\nradius = 0.0125\nmass = 0.5\nlength = 0.3\nbend_max_deg = 30\n")
                .status,
            0);
  const ProgramResult copied = run_program("score " + path("dataset") + " " + path("dataset"));
  EXPECT_EQ(copied.status, 0);
  EXPECT_EQ(copied.err, "tanglebin: warning: " + path("dataset") +
                            ": its labels are the truth's own at every point of every scene; are they the "
                            "result to score?\n");

  // Right, with other numbers.
  std::filesystem::copy(path("dataset"), path("labels"), std::filesystem::copy_options::recursive);
  std::ifstream in(path("dataset/A2/plys/1.ply"), std::ios::binary);
  PointCloud cloud = read_ply(in, "1.ply");
  for (std::int32_t& label : cloud.labels) label = label > 0 ? 3 - label : label;
  std::ofstream out(path("labels/A2/plys/1.ply"), std::ios::binary);
  write_ply(out, cloud);
  out.close();
  const ProgramResult own = run_program("score " + path("dataset") + " " + path("labels"));
  EXPECT_EQ(own.status, 0);
  EXPECT_EQ(own.err, "");
}

TEST_F(ScoreCommand, ATubeWithoutALabelHasNone) {
  write("one.ply", one_point("0.071 0.25 0", "4"));
  EXPECT_THAT(score("truth.ply", "one.ply").out,
              HasSubstr("       1        39     none         0        39  0.000\n"));
  EXPECT_TRUE(
      nlohmann::json::parse(score("truth.ply", "one.ply", "--json").out)["tubes"][0]["assigned"].is_null());
}

TEST_F(ScoreCommand, ScoresTubesTooWhereItIsGivenThem) {
  write("true.txt", tube_from(0, 0, 0.4));
  write("tubes.txt", tube_from(0, 0.0025, 0.4));
  const std::string tubes = "--true-tubes " + path("true.txt") + " --modelled-tubes " + path("tubes.txt");
  EXPECT_THAT(score_example(tubes).out, HasSubstr("centre-line error    2.50 mm  95th percentile 2.50 mm\n"
                                                  "centre-line coverage 1.000\n"
                                                  "joins                0 of 0 missing, 0 of 0 wrong\n"));
  const auto json = nlohmann::json::parse(score_example("--json " + tubes).out);
  EXPECT_EQ(json.at("points"), 72);
  EXPECT_NEAR(json.at("centre_line_error").get<double>(), 0.0025, 1e-12);
  EXPECT_NEAR(json.at("centre_line_error_p95").get<double>(), 0.0025, 1e-12);
  EXPECT_EQ(json.at("centre_line_coverage"), 1.0);
  for (const char* key : {"true_joins", "joins_found", "joins_made"}) EXPECT_EQ(json.at(key), 0) << key;
  EXPECT_FALSE(nlohmann::json::parse(score_example("--json").out).contains("centre_line_error"));
}

TEST_F(ScoreCommand, WithoutAModelledTubeThereIsNoError) {
  write("true.txt", tube_from(0, 0, 0.4));
  write("none.txt", "0\n");
  const std::string tubes = "--true-tubes " + path("true.txt") + " --modelled-tubes " + path("none.txt");
  EXPECT_THAT(score_example(tubes).out, HasSubstr("centre-line error    none  95th percentile none\n"));
  EXPECT_TRUE(nlohmann::json::parse(score_example("--json " + tubes).out)["centre_line_error"].is_null());
}

TEST_F(ScoreCommand, TakesTubesAndTrueTubesTogether) {
  write("true.txt", tube_from(0, 0, 0.4));
  EXPECT_EQ(score_example("--true-tubes " + path("true.txt")).status, 64);
  EXPECT_EQ(score_example("--modelled-tubes " + path("true.txt")).status, 64);
}

TEST_F(ScoreCommand, NeedsATrueTube) {
  write("true.txt", tube_from(0, 0, 0.4));
  write("none.txt", "0\n");
  const ProgramResult run =
      score_example("--true-tubes " + path("none.txt") + " --modelled-tubes " + path("true.txt"));
  EXPECT_EQ(run.status, 2);
  EXPECT_EQ(run.out, "");
  EXPECT_THAT(run.err, HasSubstr("none.txt: the true tubes have no centre line\n"));
}

TEST_F(ScoreCommand, ReadsTheLabelsFromStandardInput) {
  const ProgramResult run = run_program("score --json --labelled - --truth " + path("truth.ply"),
                                        test::bytes_of(path("labelled.pcd")));
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.out, score_example("--json").out);
}

TEST_F(ScoreCommand, SaysOnOneLineWhatIsWrongAndExitsWith2) {
  write("elsewhere.ply", one_point("1.5 2 3", "1"));
  write("bin.ply", one_point("1.5 2 3", "0"));
  write("story.txt", "Once upon a time");
  const auto message = [&](const std::string& truth, const std::string& labels) {
    const ProgramResult run = score(truth, labels);
    EXPECT_EQ(run.status, 2);
    EXPECT_EQ(run.out, "");
    EXPECT_EQ(std::ranges::count(run.err, '\n'), 1) << run.err;
    return run.err;
  };
  EXPECT_THAT(
      message("truth.ply", "elsewhere.ply"),
      HasSubstr("elsewhere.ply: point 1: found (1.5, 2, 3), expected the exact position of a point in"));
  EXPECT_THAT(message("bin.ply", "bin.ply"), HasSubstr("bin.ply: found no point on a tube"));
  EXPECT_THAT(message("story.txt", "labelled.pcd"), HasSubstr("story.txt: found 'O' at the start"));
  EXPECT_THAT(message("truth.ply", "absent.ply"), HasSubstr("absent.ply: cannot be opened"));
}

TEST_F(ScoreCommand, ExitsWith64WhereItIsNotCalledAsItsHelpSays) {
  EXPECT_EQ(run_program("score --truth " + path("truth.ply")).status, 64);
  EXPECT_EQ(run_program("score").status, 64);
}

TEST_F(ScoreCommand, HelpHasAnExample) {
  const ProgramResult run = run_program("score --help");
  EXPECT_EQ(run.status, 0);
  EXPECT_THAT(run.out, HasSubstr("tanglebin score --truth dataset/"));
}

}  // namespace
}  // namespace tanglebin
