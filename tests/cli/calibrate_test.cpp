#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/program.hpp"
#include "tests/support/recipe_text.hpp"

namespace tanglebin {
namespace {

using test::bytes_of;
using test::ProgramResult;
using test::run_program;
using test::run_shell;
using test::TemporaryDirectory;
using test::write_bytes;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class CalibrateCommand : public testing::Test {
protected:
  CalibrateCommand() {
    write_bytes(path("recipe.toml"),
                test::recipe_text({.seed = 3, .width = 480, .tubes = "[1, 3]", .cases = 2}));
  }

  std::string path(const std::string& name) const { return (directory_ / name).string(); }
  std::string arguments(const std::string& profile, const std::string& options = "--budget 20") const {
    return "calibrate " + path("recipe.toml") + " --out " + path(profile) + " --scenes 4 " + options;
  }

  TemporaryDirectory directory_;
};

TEST_F(CalibrateCommand, WritesAProfileThatModelReads) {
  const ProgramResult run = run_program(arguments("mine.toml"));
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, AllOf(HasSubstr("unmixed_recall on 4 scenes that it was not calibrated on"),
                             HasSubstr("before"), HasSubstr("difference")));
  EXPECT_THAT(bytes_of(path("mine.toml")),
              AllOf(HasSubstr("method = \"axis\""), HasSubstr("[made_for]"), HasSubstr("[reached]")));
  run_program("generate " + path("recipe.toml") + " --out " + path("dataset") + " --tubes 1 --cases 1");
  const ProgramResult model =
      run_program("model " + path("dataset/A1/plys/1.ply") + " --scene " + path("dataset") + " --out " +
                  path("out.ply") + " --profile " + path("mine.toml"));
  EXPECT_EQ(model.status, 0) << model.err;
  EXPECT_THAT(model.err, Not(HasSubstr("made for")));
}

TEST_F(CalibrateCommand, GoesOnAfterAKillToTheSameBytes) {
  ASSERT_EQ(run_program(arguments("whole.toml")).status, 0);
  run_shell("timeout -s KILL 0.7 " TANGLEBIN_PROGRAM " " + arguments("killed.toml"));
  ASSERT_EQ(run_program(arguments("killed.toml", "--budget 20 --jobs 1")).status, 0);
  EXPECT_EQ(bytes_of(path("killed.toml")), bytes_of(path("whole.toml")));
}

TEST_F(CalibrateCommand, PrintsTheResultAsJson) {
  const auto json = nlohmann::json::parse(run_program(arguments("mine.toml", "--budget 20 --json")).out);
  EXPECT_GE(json.at("after").at("mean"), json.at("before").at("mean"));
  EXPECT_FALSE(json.at("evaluations").get<int>() == 0);
}

TEST_F(CalibrateCommand, StopsAtATime) {
  const ProgramResult run = run_program(arguments("mine.toml", "--budget 1s"));
  EXPECT_EQ(run.status, 0) << run.err;
}

TEST_F(CalibrateCommand, StartsFromAProfileIfAsked) {
  write_bytes(path("start.toml"), "format = 1\naxis.fragment.points_min = 2000\n");
  const auto json = nlohmann::json::parse(
      run_program(arguments("mine.toml", "--budget 20 --json --start " + path("start.toml"))).out);
  EXPECT_LT(json.at("before").at("mean"), 0.5);
}

TEST_F(CalibrateCommand, RefusesWhatItCannotDo) {
  write_bytes(path("paper.toml"), "format = 1\nmethod = \"paper\"\npaper.fit.trim = 0.01\n");
  const std::pair<std::string, std::string> mistakes[] = {
      {"--budget 10weeks", "--budget: found '10weeks', expected evaluations, such as 5000, or a time"},
      {"--budget 0", "--budget: found '0'"},
      {"--objective f1",
       "--objective: found 'f1', expected one of unmixed_recall, micro_recall, panoptic_quality, "
       "complete_tubes"},
      {"--method best", "--method: found 'best'"},
      {"--downsample 0.1,0.3", "--downsample: found 2 ratios, expected one"},
      {"--start " + path("paper.toml"), "paper.toml: method: found paper, expected a profile for axis"}};
  for (const auto& [options, message] : mistakes) {
    const ProgramResult run = run_program(arguments("mine.toml", options));
    EXPECT_EQ(run.status, 2) << options;
    EXPECT_THAT(run.err, HasSubstr(message)) << options;
  }
  const ProgramResult run = run_program("calibrate " + path("recipe.toml") + " --out -");
  EXPECT_THAT(run.err, HasSubstr("--out: found '-', expected a file"));
}

TEST_F(CalibrateCommand, ModelAndExperimentWarnOfAProfileForAnotherScene) {
  ASSERT_EQ(run_program(arguments("mine.toml")).status, 0);
  run_program("generate - --out " + path("other"),
              test::recipe_text({.seed = 3, .width = 240, .tubes = "[1]", .cases = 1}));
  const ProgramResult model =
      run_program("model " + path("other/A1/plys/1.ply") + " --scene " + path("other") +
                  " --radius 0.01 --out " + path("out.ply") + " --profile " + path("mine.toml"));
  EXPECT_THAT(model.err, AllOf(HasSubstr("mine.toml: made for tubes with a radius of 0.0125 m, not 0.01 m"),
                               HasSubstr("with images 480 pixels wide"), HasSubstr("not 240 pixels wide")));
  const ProgramResult experiment =
      run_program("experiment " + path("other") + " --out " + path("results") +
                  " --downsample 1 --method axis" + " --method mine=axis:" + path("mine.toml"));
  EXPECT_EQ(experiment.status, 0) << experiment.err;
  EXPECT_THAT(experiment.err, HasSubstr("mine.toml: made for a camera with images"));
  EXPECT_THAT(experiment.out, HasSubstr("mine, set A"));
  EXPECT_EQ(run_program("experiment " + path("other") + " --out " + path("named") +
                        " --downsample 1 --profile " + path("mine.toml"))
                .status,
            0);
  EXPECT_THAT(bytes_of(path("named/experiment.json")), HasSubstr("\"profile\":\"" + path("mine.toml")));
}

TEST_F(CalibrateCommand, ModelRefusesAProfileForTheOtherMethod) {
  write_bytes(path("mine.toml"), "format = 1\nmethod = \"paper\"\npaper.fit.trim = 0.01\n");
  const ProgramResult model = run_program("model " + path("cloud.ply") + " --scene " + path("scene.toml") +
                                          " --out " + path("out.ply") + " --profile " + path("mine.toml"));
  EXPECT_EQ(model.status, 2);
  EXPECT_THAT(model.err, HasSubstr("mine.toml: method: found paper, expected a profile for axis"));
}

}  // namespace
}  // namespace tanglebin
