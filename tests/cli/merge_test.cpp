#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/program.hpp"
#include "tests/support/recipe_text.hpp"

namespace tanglebin {
namespace {

using test::files_below;
using test::ProgramResult;
using test::run_program;
using test::TemporaryDirectory;
using test::write_bytes;
using testing::HasSubstr;

class Merge : public testing::Test {
protected:
  static inline const std::string recipe =
      test::recipe_text({.seed = 3, .width = 96, .tubes = "[1]", .cases = 4});

  Merge() {
    for (const std::string shard : {"1", "2"}) {
      run_program("generate - --shard " + shard + "/2 --out " + path("part" + shard), recipe);
    }
  }
  std::string path(const std::string& name) const { return (directory_ / name).string(); }
  ProgramResult merge(const std::string& parts, const std::string& more = {}) const {
    return run_program("merge " + parts + " --out " + path("merged") + " " + more);
  }

  TemporaryDirectory directory_;
};

TEST_F(Merge, PartsAreTheRunInOnePiece) {
  const ProgramResult result = merge(path("part1") + " " + path("part2"));
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("merged: 4 cases merged in "));
  EXPECT_THAT(result.out, HasSubstr("merged: complete, 4 cases, digest "));
  run_program("generate - --out " + path("whole"), recipe);
  auto merged = files_below(path("merged"));
  auto whole = files_below(path("whole"));
  merged.erase("times.jsonl");
  whole.erase("times.jsonl");
  EXPECT_EQ(merged, whole);
}

TEST_F(Merge, SaysWhatIsStillMissing) {
  const ProgramResult result = merge(path("part2"), "--json");
  EXPECT_EQ(result.status, 0);
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json["made"], 2);
  EXPECT_EQ(json["dataset"]["cases"], 2);
  EXPECT_EQ(json["dataset"]["recipe_cases"], 4);
  EXPECT_THAT(merge(path("part2")).out, HasSubstr("merged: 2 of the recipe's 4 cases, digest "));
}

TEST_F(Merge, BadInputIsExitStatusTwoAndOneLine) {
  write_bytes(path("part1/A1/plys/1.ply"), "");
  const ProgramResult result = merge(path("part1"));
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("part1/A1/plys/1.ply: bytes: found 0, expected "));
  EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << result.err;
  EXPECT_EQ(merge(path("nothing")).status, 2);
  EXPECT_EQ(merge("").status, 64);
}

TEST_F(Merge, DoesNotMergeIntoAPart) {
  const std::string manifest = test::bytes_of(path("part1/manifest.jsonl"));
  for (const std::string& out : {path("part1"), path("part1") + "/", path("./part1")}) {
    const ProgramResult result =
        run_program("merge " + path("part2") + " " + path("part1") + " --out " + out);
    EXPECT_EQ(result.status, 2) << out;
    EXPECT_THAT(result.err,
                HasSubstr("--out: found '" + out + "', which is also an input, expected another"));
  }
  for (const std::string command : {"experiment ", "export --format coco "}) {
    const ProgramResult result = run_program(command + path("part1") + " --out " + path("part1"));
    EXPECT_EQ(result.status, 2) << command;
    EXPECT_THAT(result.err, HasSubstr("which is also an input"));
  }
  EXPECT_EQ(test::bytes_of(path("part1/manifest.jsonl")), manifest);
}

TEST_F(Merge, HelpHasAnExample) {
  EXPECT_THAT(run_program("merge --help").out, HasSubstr("tanglebin merge part1 part2 --out dataset"));
}

}  // namespace
}  // namespace tanglebin
