#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "tests/support/program.hpp"
#include "tests/support/recipe_text.hpp"

namespace tanglebin {
namespace {

using test::bytes_of;
using test::ProgramResult;
using test::run_program;
using test::TemporaryDirectory;
using test::write_bytes;
using testing::HasSubstr;

class ExperimentCommand : public testing::Test {
protected:
  static inline const std::string recipe =
      test::recipe_text({.seed = 3, .width = 240, .tubes = "[1, 2]", .cases = 2});

  ExperimentCommand() { run_program("generate - --out " + path("dataset"), recipe); }

  std::string path(const std::string& name) const { return (directory_ / name).string(); }
  ProgramResult experiment(const std::string& options, const std::string& out = "results") const {
    return run_program("experiment " + path("dataset") + " --out " + path(out) + " " + options);
  }

  std::string ratios_of(const std::string& out) const {
    return nlohmann::json::parse(bytes_of(path(out) + "/experiment.json")).at("ratios").dump();
  }

  TemporaryDirectory directory_;
};

TEST_F(ExperimentCommand, ModelsEveryCaseAndPrintsTheMeansByMethodAndSet) {
  const ProgramResult run = experiment("--method paper,axis --downsample 0.3,1");
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.err, "");  // no progress where standard error is no terminal
  EXPECT_THAT(run.out, HasSubstr("mean micro-recall at ratio 0.3\n"));
  for (const std::string method : {"paper", "axis"}) {
    EXPECT_THAT(run.out, testing::ContainsRegex(method + ", set A: [01]\\.[0-9]+ \\(1 tube, 2 cases\\), "
                                                         "[01]\\.[0-9]+ \\(2 tubes, 2 cases\\)\n"));
  }
  EXPECT_THAT(run.out, HasSubstr("results: 4 cases modelled in "));
  for (const char* file : {"experiment.json", "results.jsonl", "times.jsonl", "generation.jsonl",
                           "pictures.jsonl", "pictures/paper-worst-labels.png"}) {
    EXPECT_TRUE(std::filesystem::exists(path("results/") + file)) << file;
  }
}

TEST_F(ExperimentCommand, ModelsOnlyTheCasesAskedForAndGoesOnLater) {
  const auto first = nlohmann::json::parse(experiment("--downsample 0.5 --tubes 2 --cases 2 --json").out);
  EXPECT_EQ(first.at("made"), 1);
  EXPECT_EQ(first.at("complete"), true);
  EXPECT_EQ(first.at("ratio"), 0.5);
  EXPECT_EQ(first.at("micro_recall").at(0).at("tubes"), 2);
  const auto second = nlohmann::json::parse(experiment("--downsample 0.5 --json").out);
  EXPECT_EQ(second.at("found"), 1);
  EXPECT_EQ(second.at("made"), 3);
  EXPECT_EQ(second.at("micro_recall").at(1).at("cases"), 2);
}

TEST_F(ExperimentCommand, GivesTheMeansOfTheCasesAskedFor) {
  ASSERT_EQ(experiment("--downsample 0.5").status, 0);
  const auto again = nlohmann::json::parse(experiment("--downsample 0.5 --cases 2 --json").out);
  ASSERT_EQ(again.at("micro_recall").size(), 2U);
  for (const auto& mean : again.at("micro_recall")) EXPECT_EQ(mean.at("cases"), 1);
}

TEST_F(ExperimentCommand, TellsTheMethodsWhatASceneFileSays) {
  write_bytes(path("scene.toml"), "[[tube]]\nradius = 0.0125\n");
  const std::string options = "--cases 1 --tubes 1 --downsample 1 ";
  const ProgramResult run = experiment(options + "--scene " + path("scene.toml"));
  ASSERT_EQ(run.status, 0) << run.err;
  const auto told = nlohmann::json::parse(bytes_of(path("results/experiment.json")));
  EXPECT_EQ(told.at("scene"), "[[tube]]\nradius = 0.0125\n");
  const ProgramResult other = experiment(options);
  EXPECT_EQ(other.status, 2);
  EXPECT_THAT(other.err, HasSubstr("scene: the directory belongs to another experiment"));
  // The bin is not of this size: no point of the tube is in it.
  write_bytes(path("small.toml"), "[support]\nshape = \"bin\"\nlength = 0.03\nwidth = 0.03\nheight = 0.02\n");
  EXPECT_NE(experiment(options + "--scene " + path("small.toml"), "small").out, run.out);
}

TEST_F(ExperimentCommand, TakesRatiosAsAListOrARange) {
  experiment("--cases 1 --tubes 1 --downsample 1,0.3,0.25", "list");
  EXPECT_EQ(ratios_of("list"), "[0.25,0.3,1.0]");
  experiment("--cases 1 --tubes 1", "default");
  EXPECT_EQ(ratios_of("default"), "[0.1,0.2,0.3,0.4,0.5,0.6,0.7,0.8,0.9,1.0]");
  experiment("--cases 1 --tubes 1 --downsample 0.05:0.15:0.05", "range");
  EXPECT_EQ(ratios_of("range"), "[0.05,0.1,0.15]");
}

TEST_F(ExperimentCommand, FailedRunsAreCountedAndTheExitStatusIsThree) {
  const std::string two_radii =
      recipe + "[[set.tube]]\nradius = 0.009\nmass = 0.3\nlength = 0.4\n" + "bend_max_deg = 30\n";
  const std::string kinds = std::string(two_radii).replace(two_radii.find("[set.tube]"), 10, "[[set.tube]]");
  ASSERT_EQ(run_program("generate - --out " + path("kinds"), kinds).status, 0);
  const std::string command = "experiment " + path("kinds") + " --out " + path("results") +
                              " --method paper --method axis --downsample 0.3 --tubes 2";
  const ProgramResult run = run_program(command);
  EXPECT_EQ(run.status, 3) << run.err;
  EXPECT_THAT(run.out, HasSubstr("paper, set A: 0.000 (2 tubes, 2 cases, 2 failed)\n"));
  EXPECT_THAT(run.out, HasSubstr("\n2 runs failed, each a micro-recall of 0; " + path("results") +
                                 "/results.jsonl says why\n"));
  const auto again = nlohmann::json::parse(run_program(command + " --json").out);
  EXPECT_EQ(again.at("found"), 2);
  EXPECT_EQ(again.at("failed_runs"), 2);
  EXPECT_EQ(again.at("micro_recall").at(0).at("failed"), 2);
  EXPECT_EQ(run_program("report " + path("results") + " --out " + path("page.html")).status, 0);
  EXPECT_THAT(bytes_of(path("page.html")),
              HasSubstr("2 runs failed; a failed run counts as one that found nothing"));
}

TEST_F(ExperimentCommand, CasesWithoutAVisibleTubeAreToldOfApart) {
  const std::string aside = std::string(recipe).replace(
      recipe.find("[scanner]"), 9, "[scanner]\nlook_at = [0, {one_of = [0.0, 30.0]}, 0]");
  run_program("generate - --out " + path("dataset2"), aside);
  const ProgramResult run =
      run_program("experiment " + path("dataset2") + " --out " + path("r") + " --downsample 0.3");
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, testing::ContainsRegex("\n[1-4] cases? without a visible tube, in no mean\n"));
}

TEST_F(ExperimentCommand, BadInputIsExitStatusTwoAndOneLine) {
  const auto expect_error = [&](const ProgramResult& run, const std::string& message) {
    EXPECT_EQ(run.status, 2);
    EXPECT_THAT(run.err, HasSubstr(message));
    EXPECT_EQ(std::ranges::count(run.err, '\n'), 1) << run.err;
    EXPECT_EQ(run.out, "");
  };
  for (const std::string ratio :
       {"0", "1.1", "-0.1", "nan", "some", "0.1,", "", "0.1:2:0.1", "0.1:1:0", "0.12345678901"}) {
    expect_error(experiment("--downsample '" + ratio + "'"), "--downsample: found '");
  }
  expect_error(experiment("--downsample 0.1:1"), "first:last:step");
  expect_error(experiment("--downsample 0.1:1:0.2"), "a step that leads from the first ratio to the last");
  expect_error(experiment("--downsample 1:0.1:0.1"), "a step that leads from the first ratio to the last");
  expect_error(experiment("--downsample 0.3,0.30"), "each ratio once");
  expect_error(experiment("--downsample 0.000000001:1:0.000000001"), "at most a thousand ratios");
  expect_error(experiment("--method none"), "tanglebin: --method: found 'none', expected one of paper, axis");
  expect_error(
      experiment("--set C"),
      "dataset: no case matches --set, --tubes and --cases; there are set A with 1-2 tubes and cases 1-2");
  expect_error(run_program("experiment " + path("") + " --out " + path("r")),
               "found no recipe.toml in it, expected the directory of a dataset");
  EXPECT_FALSE(std::filesystem::exists(path("results")));

  EXPECT_EQ(experiment("--downsample 0.3 --cases 1").status, 0);
  expect_error(experiment("--downsample 0.4"), "another experiment: it has [0.3], this one [0.4]");
  write_bytes(path("dataset/A2/plys/2.ply"), "");
  expect_error(experiment("--downsample 0.3"), "A2/plys/2.ply: bytes: found 0, expected ");
}

TEST_F(ExperimentCommand, WrongUsageIsExitStatus64) {
  EXPECT_EQ(run_program("experiment").status, 64);
  EXPECT_EQ(run_program("experiment " + path("dataset")).status, 64);
  EXPECT_EQ(experiment("--jobs 0").status, 64);
}

TEST_F(ExperimentCommand, HelpHasAnExample) {
  const ProgramResult run = run_program("experiment --help");
  EXPECT_EQ(run.status, 0);
  EXPECT_THAT(run.out, HasSubstr("tanglebin experiment dataset --out results"));
}

TEST_F(ExperimentCommand, TellsAProgramOfEachEventInALineOfJson) {
  const ProgramResult run = experiment("--downsample 0.5 --progress json");
  EXPECT_EQ(run.status, 0) << run.err;
  std::istringstream lines(run.out);
  int cases = 0;
  nlohmann::json last;
  for (std::string line; std::getline(lines, line);) {
    last = nlohmann::json::parse(line);
    if (last.at("event") != "case") continue;
    ++cases;
    EXPECT_EQ(last.at("set"), "A");
    EXPECT_TRUE(last.at("seconds").is_number());
  }
  EXPECT_EQ(cases, 4);
  EXPECT_EQ(last.at("event"), "end");
  EXPECT_EQ(last.at("made"), 4);
  EXPECT_EQ(last.at("micro_recall").size(), 2U);
}

}  // namespace
}  // namespace tanglebin
