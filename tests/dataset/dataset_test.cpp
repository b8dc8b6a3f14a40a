#include "tanglebin/dataset/dataset.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tanglebin/base/error.hpp"
#include "tanglebin/dataset/generate_dataset.hpp"
#include "tanglebin/dataset/sha256.hpp"
#include "tests/dataset/small_recipe.hpp"
#include "tests/support/temporary_directory.hpp"

namespace tanglebin {
namespace {

using test::bytes_of;
using test::small_recipe;
using test::TemporaryDirectory;
using test::write_bytes;
using testing::HasSubstr;

/// A dataset of which two cases of six are there.
class DatasetOnDisk : public testing::Test {
protected:
  DatasetOnDisk() { generate_dataset(small_recipe(), {{"A", 3, 2}, {"A", 1, 3}}, directory_.path(), 1); }

  std::string error_of_case() const {
    try {
      read_case(read_dataset(directory_.path()), {"A", 3, 2});
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }

  TemporaryDirectory directory_;
};

TEST_F(DatasetOnDisk, SaysWhichCasesAreThereInTheRecipesOrder) {
  const Dataset dataset = read_dataset(directory_.path());
  EXPECT_EQ(cases(dataset), (std::vector<CaseId>{{"A", 1, 3}, {"A", 3, 2}}));
  EXPECT_EQ(cases(dataset.recipe).size(), 6U);
  EXPECT_EQ(dataset.recipe_sha256, sha256(bytes_of(directory_ / "recipe.toml")));
}

TEST_F(DatasetOnDisk, GivesACaseBack) {
  const CaseData data = read_case(read_dataset(directory_.path()), {"A", 3, 2});
  EXPECT_EQ(data.cloud_file, (directory_ / "A3/plys/2.ply").string());
  EXPECT_EQ(data.tubes.size(), 3U);
  EXPECT_THAT(data.cloud.labels, testing::Contains(3));
}

TEST_F(DatasetOnDisk, AMissingFileIsAnErrorThatNamesIt) {
  std::filesystem::remove(directory_ / "A3/tube_configurations/2.txt");
  EXPECT_THAT(error_of_case(), HasSubstr("A3/tube_configurations/2.txt: cannot be opened: No such file"));
}

TEST_F(DatasetOnDisk, AFileThatHasChangedIsAnErrorThatNamesIt) {
  const auto file = directory_ / "A3/plys/2.ply";
  std::string bytes = bytes_of(file);
  bytes.back() ^= 1;
  write_bytes(file, bytes);
  EXPECT_THAT(error_of_case(), HasSubstr("A3/plys/2.ply: sha256: found " + sha256(bytes) + ", expected "));
}

TEST_F(DatasetOnDisk, AManifestThatIsReplacedMeanwhileIsAnError) {
  const Dataset dataset = read_dataset(directory_.path());
  const std::string manifest = bytes_of(directory_ / "manifest.jsonl");
  const std::size_t second = manifest.find('\n') + 1;
  write_bytes(directory_ / "manifest.jsonl",
              manifest.substr(second) + std::string(second, ' ') + manifest.substr(second));
  EXPECT_THROW(read_case(dataset, {"A", 1, 3}), InputError);
}

TEST_F(DatasetOnDisk, TheTimesOfItsCasesAreReadLineByLine) {
  const Dataset dataset = read_dataset(directory_.path());
  std::string lines;
  dataset.catalogue.for_each_times_line({{"A", 3, 2}, {"A", 1, 1}, {"A", 1, 3}},
                                        [&](const std::string& line) { lines += line + '\n'; });
  const std::string times = bytes_of(directory_ / "times.jsonl");
  const std::size_t second = times.find('\n') + 1;
  EXPECT_EQ(lines, times.substr(second) + times.substr(0, second));
}

TEST_F(DatasetOnDisk, ADirectoryWithoutARecipeIsNoDataset) {
  std::filesystem::remove(directory_ / "recipe.toml");
  EXPECT_THAT(error_of_case(), HasSubstr("recipe.toml: cannot be opened"));
}

}  // namespace
}  // namespace tanglebin
