#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/program.hpp"
#include "tests/support/recipe_text.hpp"

namespace tanglebin {
namespace {

using test::ProgramResult;
using test::run_program;
using test::TemporaryDirectory;
using testing::HasSubstr;

class Export : public testing::Test {
protected:
  Export() {
    run_program("generate - --out " + dataset(),
                test::recipe_text({.seed = 3, .width = 96, .tubes = "[2]", .cases = 4}));
  }
  std::string dataset() const { return (directory_ / "dataset").string(); }
  std::string out() const { return (directory_ / "out").string(); }
  ProgramResult run(const std::string& arguments) const {
    return run_program("export " + dataset() + " --out " + out() + " " + arguments);
  }

  TemporaryDirectory directory_;
};

TEST_F(Export, SaysWhatItHasWrittenAndResumes) {
  const ProgramResult first = run("--format numpy --jobs 2");
  EXPECT_EQ(first.status, 0) << first.err;
  EXPECT_THAT(first.out, HasSubstr("4 cases exported in "));
  EXPECT_THAT(first.out, HasSubstr("0 already there; the export is complete"));
  std::filesystem::remove(directory_ / "out/A2/3.npz");
  const auto again = nlohmann::json::parse(run("--format numpy --json").out);
  EXPECT_EQ(again["made"], 1);
  EXPECT_EQ(again["found"], 3);
  EXPECT_EQ(again["complete"], true);
}

TEST_F(Export, ShardsSayWhetherOthersAreToCome) {
  EXPECT_THAT(run("--format coco --shard 2/2").out, HasSubstr("other shards are to come or in progress"));
  EXPECT_FALSE(std::filesystem::exists(directory_ / "out/annotations/instances.json"));
  EXPECT_THAT(run("--format coco --shard 1/2").out, HasSubstr("the export is complete"));
  EXPECT_TRUE(std::filesystem::exists(directory_ / "out/annotations/instances.json"));
}

TEST_F(Export, RejectsAFormatThatItDoesNotHaveAndAnotherExport) {
  const ProgramResult unknown = run("--format yolo");
  EXPECT_EQ(unknown.status, 2);
  EXPECT_THAT(
      unknown.err,
      HasSubstr("tanglebin: --format: found 'yolo', expected one of coco, numpy, webdataset, hdf5, bop"));
  EXPECT_EQ(run("--format hdf5 --cases 1").status, 0);
  const ProgramResult other = run("--format hdf5 --cases 1-2");
  EXPECT_EQ(other.status, 2);
  EXPECT_THAT(other.err, HasSubstr("the directory has another export"));
}

}  // namespace
}  // namespace tanglebin
