#include "tanglebin/dataset/merge_datasets.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tanglebin/dataset/generate_dataset.hpp"
#include "tanglebin/runs/shard.hpp"
#include "tests/dataset/small_recipe.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/temporary_directory.hpp"

namespace tanglebin {
namespace {

using test::bytes_of;
using test::complaint;
using test::failed_case_of;
using test::files_below;
using test::small_recipe;
using test::TemporaryDirectory;
using test::write_bytes;
using testing::HasSubstr;

class MergeDatasets : public testing::Test {
protected:
  void make_parts(int count) {
    for (int index = 1; index <= count; ++index) {
      parts_.push_back(directory_ / ("part-" + std::to_string(index)));
      generate_dataset(recipe_, part_of({index, count}, cases(recipe_)), parts_.back(), 1);
    }
  }

  // Everything but how long it took.
  static std::map<std::string, std::string> dataset_in(const std::filesystem::path& directory) {
    auto files = files_below(directory);
    files.erase("times.jsonl");
    return files;
  }

  std::map<std::string, std::string> whole() const {
    generate_dataset(recipe_, cases(recipe_), directory_ / "whole", 1);
    return dataset_in(directory_ / "whole");
  }

  TemporaryDirectory directory_;
  Recipe recipe_ = small_recipe();
  std::vector<std::filesystem::path> parts_;
  std::filesystem::path merged_ = directory_ / "merged";
};

TEST_F(MergeDatasets, PartsThatWereMadeApartAreTheRunInOnePiece) {
  make_parts(4);
  const FillSummary summary = merge_datasets(parts_, merged_, 2);
  EXPECT_EQ(summary.progress.made, 6U);
  EXPECT_TRUE(summary.dataset->is_complete());
  EXPECT_EQ(dataset_in(merged_), whole());
}

TEST_F(MergeDatasets, KeepHowLongEachCaseTook) {
  make_parts(1);
  merge_datasets(parts_, merged_, 1);
  EXPECT_EQ(bytes_of(merged_ / "times.jsonl"), bytes_of(parts_[0] / "times.jsonl"));
}

TEST_F(MergeDatasets, SomeOfThePartsAreASmallerDatasetThatGrowsLater) {
  make_parts(3);
  EXPECT_EQ(merge_datasets({parts_[2]}, merged_, 1).dataset->cases, 2U);
  const FillSummary rest = merge_datasets(parts_, merged_, 1);
  EXPECT_EQ(rest.progress.found, 2U);
  EXPECT_EQ(rest.progress.made, 4U);
  EXPECT_EQ(dataset_in(merged_), whole());
}

TEST_F(MergeDatasets, TakeWhatAPartHasOnlyInItsJournal) {
  make_parts(2);
  const std::string record = bytes_of(parts_[0] / "manifest.jsonl");
  const std::string times = bytes_of(parts_[0] / "times.jsonl");
  write_bytes(parts_[0] / "journal.jsonl",
              record.substr(0, record.find('\n')) + '\t' + times.substr(0, times.find('\n') + 1));
  std::filesystem::remove(parts_[0] / "manifest.jsonl");
  EXPECT_EQ(merge_datasets(parts_, merged_, 1).progress.made, 1U + 3U);
}

TEST_F(MergeDatasets, CasesThatFailedInAPartAreKnownToHaveFailed) {
  make_parts(2);
  const FailedCase failed = failed_case_of(1, 17, "no valid scene");
  write_bytes(parts_[1] / "failed.jsonl",
              to_json(failed) + '\n' + to_json(failed_case_of(2, 18, "x")) + '\n');
  std::string manifest = bytes_of(parts_[0] / "manifest.jsonl");
  write_bytes(parts_[0] / "manifest.jsonl", manifest.substr(manifest.find('\n') + 1));
  merge_datasets(parts_, merged_, 1);
  EXPECT_EQ(bytes_of(merged_ / "failed.jsonl"), to_json(failed) + '\n');  // the other one is there after all
}

TEST_F(MergeDatasets, APartOfAnotherRecipeIsAnErrorThatNamesTheDifference) {
  make_parts(2);
  recipe_.seed = 8;
  generate_dataset(recipe_, {{"A", 1, 1}}, directory_ / "other", 1);
  EXPECT_THAT(
      complaint([&] {
        merge_datasets({parts_[0], directory_ / "other"}, merged_, 1);
      }),
      HasSubstr("other/recipe.toml: the directory belongs to another recipe: seed: it has 8, this one 7"));
  EXPECT_FALSE(std::filesystem::exists(merged_));
}

TEST_F(MergeDatasets, AFileThatHasChangedIsAnErrorThatNamesItAndIsNotCopied) {
  make_parts(1);
  write_bytes(parts_[0] / "A1/plys/2.ply", "ply\n");
  EXPECT_THAT(complaint([&] { merge_datasets(parts_, merged_, 1); }),
              HasSubstr("A1/plys/2.ply: bytes: found 4, expected "));
  EXPECT_FALSE(std::filesystem::exists(merged_ / "A1/plys/2.ply"));
}

TEST_F(MergeDatasets, TwoPartsWithOneCaseInDifferentBytesAreAnError) {
  make_parts(1);
  generate_dataset(recipe_, {{"A", 1, 1}}, directory_ / "other", 1);
  std::string manifest = bytes_of(directory_ / "other/manifest.jsonl");
  manifest.replace(manifest.find("\"sha256\":\"") + 10, 4, "0000");
  write_bytes(directory_ / "other/manifest.jsonl", manifest);
  EXPECT_THAT(complaint([&] {
                merge_datasets({parts_[0], directory_ / "other"}, merged_, 1);
              }),
              HasSubstr("other/manifest.jsonl: A1/1: another scene than in " + parts_[0].string()));
}

TEST_F(MergeDatasets, ACaseThatIsNotTheRecipesOrAPathThatLeadsOutIsAnError) {
  make_parts(1);
  const std::string manifest = bytes_of(parts_[0] / "manifest.jsonl");
  std::string other = manifest;
  other.replace(other.find("\"case\":1"), 8, "\"case\":9");
  write_bytes(parts_[0] / "manifest.jsonl", other);
  EXPECT_THAT(complaint([&] { merge_datasets(parts_, merged_, 1); }),
              HasSubstr("manifest.jsonl: A1/9: not a case of the recipe"));
  std::string outside = manifest;
  outside.replace(outside.find("A1/plys/1.ply"), 13, "../../out.ply");
  write_bytes(parts_[0] / "manifest.jsonl", outside);
  EXPECT_THAT(
      complaint([&] { merge_datasets(parts_, merged_, 1); }),
      HasSubstr("files[0].path: found '../../out.ply', expected a path below the dataset's directory"));
  EXPECT_FALSE(std::filesystem::exists(directory_ / "out.ply"));
}

TEST_F(MergeDatasets, WhatIsNoDatasetIsAnError) {
  EXPECT_THAT(complaint([&] { merge_datasets({directory_ / "none"}, merged_, 1); }),
              HasSubstr("none/recipe.toml: "));
}

TEST_F(MergeDatasets, APathThatIsNoneOfTheCasesOwnIsAnError) {
  make_parts(1);
  std::string manifest = bytes_of(parts_[0] / "manifest.jsonl");
  manifest.replace(manifest.find("A1/plys/1.ply"), 13, "recipe.toml");
  write_bytes(parts_[0] / "manifest.jsonl", manifest);
  EXPECT_THAT(complaint([&] { merge_datasets(parts_, merged_, 1); }),
              HasSubstr("manifest.jsonl: A1/1: found recipe.toml, expected one of the case's own files"));
}

TEST_F(MergeDatasets, AFolderThatIsALinkToOutsideIsAnErrorWhereFilesAreReadAndWritten) {
  make_parts(1);
  const std::filesystem::path elsewhere = directory_ / "elsewhere";
  std::filesystem::rename(parts_[0] / "A1", elsewhere);
  std::filesystem::create_symlink(elsewhere, parts_[0] / "A1");
  EXPECT_THAT(complaint([&] { merge_datasets(parts_, merged_, 1); }),
              HasSubstr("A1/plys/1.ply: found a folder that leads to " + elsewhere.string()));

  std::filesystem::remove(parts_[0] / "A1");
  std::filesystem::rename(elsewhere, parts_[0] / "A1");
  std::filesystem::create_directories(elsewhere);
  std::filesystem::remove_all(merged_ / "A1");
  std::filesystem::create_symlink(elsewhere, merged_ / "A1");
  EXPECT_THAT(complaint([&] { merge_datasets(parts_, merged_, 1); }), HasSubstr("a folder that leads to "));
  EXPECT_TRUE(std::filesystem::is_empty(elsewhere));  // not even a folder
}

}  // namespace
}  // namespace tanglebin
