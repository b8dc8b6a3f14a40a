#include "tanglebin/profile/profile.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "tanglebin/model/parameters.hpp"
#include "tests/support/complaint.hpp"

namespace tanglebin {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;

ModelSettings read(const std::string& text) {
  std::istringstream in(text);
  ModelSettings settings;
  apply(read_profile(in, "profile.toml"), settings);
  return settings;
}

std::string complaint_about(const std::string& text) {
  return test::complaint([&] { read(text); });
}

TEST(Profile, SetsTheParametersThatItNamesAndLeavesTheOthers) {
  const ModelSettings settings = read(
      "format = 1\n"
      "axis.vote.floor_margin = 0.4\n"
      "[axis.link.weights.junction]\n"
      "beyond = -2\n");
  EXPECT_THAT(changed_parameters(settings), ElementsAre(Pair("axis.link.weights.junction.beyond", -2),
                                                        Pair("axis.vote.floor_margin", 0.4)));
}

TEST(Profile, ReadsBackWhatWasWritten) {
  ModelSettings settings;
  double value = -1.0 / 3;
  for (const auto& [name, weight] : link_parameters(LinkWeights{}))
    set_parameter(settings, name, value *= -1.1);
  std::ostringstream out;
  write_profile(out, {.parameters = changed_parameters(settings)}, "learned");
  EXPECT_THAT(out.str(), HasSubstr("# learned\n"));
  EXPECT_EQ(parameters(read(out.str())), parameters(settings));
}

Profile calibrated() {
  return {.parameters = {{"axis.vote.floor_margin", 0.4}, {"axis.link.weights.junction.beyond", -2.5}},
          .method = Method::axis,
          .made_for = MadeFor{.scanner = "zivid-one-plus-l",
                              .image_width = 1920,
                              .focal_length = 2730,
                              .bin = {.length = 0.8, .width = 0.6, .height = 0.25},
                              .recipe_sha256 = "ab12",
                              .version = "0.2.0",
                              .program_sha256 = "cd34",
                              .tubes = {{0.004, 0.004, 0.3, 0.3}, {0.008, 0.01, 1, 1.2}}},
          .reached = Reached{.objective = "micro_recall",
                             .ratio = 0.3,
                             .scenes = 40,
                             .before = {0.9, 0.88, 0.92},
                             .after = {0.95, 0.94, 0.96},
                             .difference = {0.05, 0.04, 0.06}}};
}

std::string written(const Profile& profile) {
  std::ostringstream out;
  write_profile(out, profile, "calibrated");
  return std::move(out).str();
}

TEST(Profile, OfACalibrationReadsBackAsItWas) {
  std::istringstream in(written(calibrated()));
  EXPECT_EQ(read_profile(in, "profile.toml"), calibrated());
}

TEST(Profile, SaysWhatItsParametersMean) {
  EXPECT_THAT(
      written(calibrated()),
      HasSubstr(
          "axis.vote.floor_margin = 0.4  # radii; points nearer to the floor are not on a visible tube"));
}

TEST(Profile, SaysWhatIsWrongWithWhatItWasMadeFor) {
  const auto with = [](const std::string& from, const std::string& to) {
    std::string text = written(calibrated());
    text.replace(text.find(from), from.size(), to);
    return complaint_about(text);
  };
  EXPECT_THAT(with("method = \"axis\"", "method = \"best\""),
              HasSubstr("found 'best', expected one of paper, axis"));
  EXPECT_THAT(with("image_width = 1920", "image_width = 0"),
              HasSubstr("made_for.image_width: found 0, expected a number above 0"));
  EXPECT_THAT(with("scanner = ", "scaner = "),
              HasSubstr("made_for: unknown key 'scaner', did you mean 'scanner'?"));
  EXPECT_THAT(with("radius_min = 0.004\n", ""), HasSubstr("made_for.tube[0].radius_min: is missing"));
  EXPECT_THAT(with("low = 0.88, ", ""), HasSubstr("reached.before.low: is missing"));
  EXPECT_THAT(with("\"ab12\"", "\"ab\\n12\""), HasSubstr("expected text without quotes"));
}

TEST(Profile, IsOnlyForItsMethod) {
  expect_for(calibrated(), {Method::paper, Method::axis}, "mine.toml");
  expect_for({}, {Method::paper}, "any.toml");
  EXPECT_EQ(test::complaint([] { expect_for(calibrated(), {Method::paper}, "mine.toml"); }),
            "mine.toml: method: found axis, expected a profile for paper");
}

KnownScene scene_with(double radius, double length) {
  KnownScene known;
  known.camera.width = 1920;
  known.camera.fx = 2730;
  known.kinds[0].radius = radius;
  known.kinds[0].segments[0].length = length;
  return known;
}

TEST(DoubtsOfAProfile, NameTheDifferenceToTheScene) {
  EXPECT_THAT(doubts_of(calibrated(), scene_with(0.009, 1.1)), testing::IsEmpty());
  EXPECT_THAT(doubts_of(calibrated(), scene_with(0.00405, 0.3)), testing::IsEmpty());
  EXPECT_THAT(doubts_of(calibrated(), scene_with(0.0125, 1.1)),
              ElementsAre("made for tubes with a radius of 0.004 or 0.008 to 0.01 m, not 0.0125 m"));
  EXPECT_THAT(doubts_of(calibrated(), scene_with(0.004, 1.1)),
              ElementsAre("made for tubes with a length of 0.3 or 1 to 1.2 m, not 1.1 m"));
  KnownScene other = scene_with(0.009, 1.1);
  other.camera.fx = 2430;
  EXPECT_THAT(doubts_of(calibrated(), other), ElementsAre(HasSubstr("focal length of 2730 pixels, not")));
  EXPECT_THAT(doubts_of({}, other), testing::IsEmpty());
}

TEST(Profile, SaysWhichLineIsWrong) {
  EXPECT_THAT(complaint_about("axis.vote.floor_margin = 0.4\n"), HasSubstr("profile.toml"));
  EXPECT_THAT(complaint_about("axis.vote.floor_margin = 0.4\n"), HasSubstr("format: is missing"));
  EXPECT_THAT(complaint_about("format = 2\n"), HasSubstr("profile.toml:1: format: found 2, expected 1"));
  EXPECT_THAT(
      complaint_about("format = 1\naxis.vote.flor_margin = 0.4\n"),
      HasSubstr("profile.toml:2: found 'axis.vote.flor_margin', did you mean 'axis.vote.floor_margin'?"));
  EXPECT_THAT(complaint_about("format = 1\naxis.vote.floor_margin = \"much\"\n"),
              HasSubstr("profile.toml:2: axis.vote.floor_margin: found 'much', expected a number"));
  EXPECT_THAT(complaint_about("format = 1\naxis.vote.floor_margin = [0.4]\n"),
              HasSubstr("expected a number"));
  EXPECT_THAT(complaint_about("format = 1\n\naxis.vote.floor_margin = -1\n"),
              HasSubstr("profile.toml:3: axis.vote.floor_margin: found -1, expected a number from 0 to 100"));
  EXPECT_THAT(
      complaint_about("format = 1\naxis.link.weights.junction.beyond = inf\n"),
      HasSubstr("axis.link.weights.junction.beyond: found inf, expected a number from -1000000 to 1000000"));
}

TEST(Profile, ThatIsNotThereIsAnError) {
  const auto complaint = test::complaint([] { read_profile("/nowhere/profile.toml"); });
  EXPECT_THAT(complaint, HasSubstr("/nowhere/profile.toml: cannot be opened"));
}

}  // namespace
}  // namespace tanglebin
