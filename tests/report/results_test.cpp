#include "tanglebin/report/results.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "tanglebin/base/error.hpp"
#include "tests/report/synthetic_results.hpp"
#include "tests/support/temporary_directory.hpp"

namespace tanglebin {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// A results directory of one case that was run with one ratio.
class ResultsDirectory : public testing::Test {
protected:
  ResultsDirectory() {
    test::write_synthetic_results(directory_.path(),
                                  {.sets = {"A"}, .tubes = {3}, .cases = 1, .ratios = {0.3}});
  }

  Results read() const { return read_results_directory(directory_.path()); }

  /// Replaces a piece of text in a file.
  void change(const std::string& file, const std::string& from, const std::string& to) const {
    std::string text = test::bytes_of(directory_ / file);
    ASSERT_NE(text.find(from), std::string::npos) << file;
    text.replace(text.find(from), from.size(), to);
    test::write_bytes(directory_ / file, text);
  }

  void expect_error(const std::string& part, const std::string& another) const {
    EXPECT_THAT([&] { read(); }, ThrowsMessage<InputError>(AllOf(HasSubstr(part), HasSubstr(another))));
  }

  test::TemporaryDirectory directory_;
};

TEST_F(ResultsDirectory, IsReadAsItStands) {
  const Results results = read();
  EXPECT_EQ(results.experiment.version, "0.1.0");
  EXPECT_EQ(results.experiment.dataset_seed, 2022U);
  EXPECT_EQ(results.experiment.ratios, std::vector<double>{0.3});
  ASSERT_EQ(results.scores.size(), 1U);
  EXPECT_EQ(results.scores[0].run.id, (CaseId{"A", 3, 1}));
  EXPECT_EQ(results.scores[0].run.method, "paper");
  EXPECT_EQ(results.scores[0].true_joins, 2U);
  ASSERT_EQ(results.times.size(), 1U);
  EXPECT_EQ(results.times[0].run.ratio, 0.3);
  ASSERT_EQ(results.generation.size(), 1U);
  EXPECT_EQ(results.generation[0].times.scan, 0.21);
  ASSERT_EQ(results.pictures.size(), 3U);
  EXPECT_EQ(results.pictures[0].rank, "best");
  EXPECT_EQ(results.pictures[0].truth_png, test::picture_png(120, 90));
  EXPECT_FALSE(results.unfinished);
}

TEST_F(ResultsDirectory, ATubeThatWasNotFoundHasNoCentreLineError) {
  const std::string line = test::bytes_of(directory_ / "results.jsonl");
  const std::size_t value = line.find("\"centre_line_error\":");
  change("results.jsonl", line.substr(value, line.find(',', value) - value), "\"centre_line_error\":null");
  EXPECT_FALSE(read().scores[0].centre_line_error.has_value());
}

TEST_F(ResultsDirectory, ARunThatFailedHasItsReasonAndFoundNothing) {
  const std::string run = R"({"set":"A","tubes":3,"case":1,"method":"paper","ratio":0.3,"failure_of":)";
  test::write_bytes(directory_ / "results.jsonl",
                    run + "\"method\",\"failure\":\"why\"}\n" + run + "\"scene\",\"failure\":\"dark\"}\n");
  const Results results = read();
  ASSERT_EQ(results.scores.size(), 1U);
  EXPECT_EQ(results.scores[0].failure, "why");
  EXPECT_EQ(results.scores[0].micro_recall, 0);
  EXPECT_EQ(results.unscored.size(), 1U);
  change("results.jsonl", "\"scene\"", "\"moon\"");
  expect_error("results.jsonl:2: failure_of: ", "found 'moon', expected scene, method or worker");
}

TEST_F(ResultsDirectory, WhatIsMissingIsEmpty) {
  for (const char* file : {"results.jsonl", "times.jsonl", "generation.jsonl", "pictures.jsonl"}) {
    std::filesystem::remove(directory_ / file);
  }
  const Results results = read();
  EXPECT_TRUE(results.scores.empty());
  EXPECT_TRUE(results.times.empty());
  EXPECT_TRUE(results.generation.empty());
  EXPECT_TRUE(results.pictures.empty());
}

TEST_F(ResultsDirectory, AJournalIsOfAnExperimentThatIsNotFinished) {
  test::write_bytes(directory_ / "journal.jsonl", "whatever");
  EXPECT_TRUE(read().unfinished);
}

TEST_F(ResultsDirectory, APictureThatIsMissingIsEmpty) {
  std::filesystem::remove(directory_ / "pictures/paper-best-truth.png");
  EXPECT_EQ(read().pictures[0].truth_png, "");
}

TEST_F(ResultsDirectory, WithoutExperimentJsonItIsNone) {
  std::filesystem::remove(directory_ / "experiment.json");
  expect_error("experiment.json", "tanglebin experiment");
}

TEST_F(ResultsDirectory, ALineThatIsCutOffIsNamed) {
  test::write_bytes(directory_ / "results.jsonl", test::bytes_of(directory_ / "results.jsonl") + "{\"set\":");
  expect_error("results.jsonl:2: ", "expected a JSON object");
}

TEST_F(ResultsDirectory, AMissingValueIsNamed) {
  change("times.jsonl", "\"seconds\"", "\"second\"");
  expect_error("times.jsonl:1: seconds: ", "is missing");
}

TEST_F(ResultsDirectory, AValueOfAnotherTypeIsNamed) {
  change("results.jsonl", "\"tubes\":3", "\"tubes\":\"three\"");
  expect_error("results.jsonl:1: tubes: ", "expected a whole number");
}

TEST_F(ResultsDirectory, AValueOutOfRangeIsNamed) {
  change("results.jsonl", "\"micro_recall\":0.", "\"micro_recall\":7.");
  expect_error("results.jsonl:1: micro_recall: found '7.", "expected a number from 0 to 1");
  change("experiment.json", "[0.3]", "[0.3,0]");
  expect_error("experiment.json: ratios: ", "found '0'");
}

TEST_F(ResultsDirectory, AnUnknownRankIsNamed) {
  change("pictures.jsonl", "\"best\"", "\"<b>\"");
  expect_error("pictures.jsonl:1: rank: found '<b>'", "expected best, median or worst");
}

TEST_F(ResultsDirectory, NamesNoPictureOutsideOfIt) {
  change("pictures.jsonl", "pictures/paper-best-truth.png", "pictures/../../other.png");
  expect_error("pictures.jsonl:1: truth: found 'pictures/../../other.png'", "below the results directory");
  change("pictures.jsonl", "pictures/../../other.png", "/other.png");
  expect_error("pictures.jsonl:1: truth: found '/other.png'", "below the results directory");
}

// Found by fuzzing: to ask whether there is a file of such a name is an error, not a no.
TEST_F(ResultsDirectory, APictureWhoseNameIsTooLongIsNamed) {
  change("pictures.jsonl", "pictures/paper-best-truth.png", "pictures/" + std::string(300, 'L'));
  expect_error("pictures/LLL", "File name too long");
}

TEST_F(ResultsDirectory, ScenesAreReadAsTheyAre) {
  const std::string scene =
      R"({"name":"A3/1","points":{"count":0},"palette":["#808080"],"labellings":[{"name":"truth"}]})";
  test::write_bytes(directory_ / "scenes.jsonl", scene + "\n");
  EXPECT_EQ(read().scenes, std::vector<std::string>{scene});
  change("scenes.jsonl", "\"truth\"", "3");
  expect_error("scenes.jsonl:1: labellings[0].name: ", "found '3'");
}

TEST_F(ResultsDirectory, TimesOfGenerationAreReadAsStrictly) {
  change("generation.jsonl", "\"settle\"", "\"sett\"");
  expect_error("generation.jsonl:1: ", "settle");
}

TEST_F(ResultsDirectory, APictureMustBeOne) {
  test::write_bytes(directory_ / "pictures/paper-best-truth.png", "root:x:0:0");
  expect_error("paper-best-truth.png", "expected a PNG picture");
}

}  // namespace
}  // namespace tanglebin
