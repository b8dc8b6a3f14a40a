// A real full disk: a file system in memory that is too small. Mounting one needs root; elsewhere this is
// skipped.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mount.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string>

#include "tests/support/program.hpp"
#include "tests/support/recipe_text.hpp"

namespace tanglebin {
namespace {

namespace fs = std::filesystem;
using test::bytes_of;
using test::files_below;
using test::ProgramResult;
using test::run_program;
using test::TemporaryDirectory;
using test::write_bytes;
using testing::HasSubstr;

class FullDisk : public testing::Test {
protected:
  static inline const std::string recipe =
      test::recipe_text({.seed = 6, .width = 192, .tubes = "[1]", .cases = 40});

  void SetUp() override {
    write_bytes(directory_ / "recipe.toml", recipe);
    fs::create_directory(disk_);
    if (!mount_with("size=1m", 0))
      GTEST_SKIP() << "cannot mount a small tmpfs here: " << std::strerror(errno);
    is_mounted_ = true;
  }
  ~FullDisk() override {
    if (is_mounted_) umount(disk_.c_str());
  }

  bool mount_with(const std::string& options, unsigned long flags) const {
    return mount("tmpfs", disk_.c_str(), "tmpfs", flags, options.c_str()) == 0;
  }

  ProgramResult generate(const fs::path& out) const {
    return run_program("generate " + (directory_ / "recipe.toml").string() + " --jobs 2 --out " +
                       out.string());
  }

  static std::map<std::string, std::string> dataset_in(const fs::path& directory) {
    auto files = files_below(directory);
    files.erase("times.jsonl");
    return files;
  }

  TemporaryDirectory directory_;
  fs::path disk_ = directory_ / "disk";
  bool is_mounted_ = false;
};

TEST_F(FullDisk, IsAnErrorThatLosesNoFinishedCaseAndTheRunGoesOnWhenThereIsSpace) {
  ASSERT_EQ(generate(directory_ / "whole").status, 0);
  const ProgramResult full = generate(disk_ / "dataset");
  EXPECT_EQ(full.status, 5);
  EXPECT_THAT(full.err, HasSubstr("No space left on device"));
  EXPECT_EQ(std::ranges::count(full.err, '\n'), 1) << full.err;

  // What is finished is there, and whole.
  const auto whole = dataset_in(directory_ / "whole");
  std::size_t clouds = 0;
  for (const auto& [name, bytes] : files_below(disk_ / "dataset/A1")) {
    EXPECT_EQ(bytes, whole.at("A1/" + name)) << name;
    if (name.ends_with(".ply")) ++clouds;
  }
  EXPECT_GT(clouds, 3U);
  EXPECT_LT(clouds, 40U);
  EXPECT_EQ(generate(disk_ / "dataset").status, 5);  // it is still full

  ASSERT_TRUE(mount_with("size=64m", MS_REMOUNT));
  const ProgramResult rest = generate(disk_ / "dataset");
  EXPECT_EQ(rest.status, 0) << rest.err;
  EXPECT_THAT(rest.out, testing::Not(HasSubstr(": 40 cases generated")));
  EXPECT_EQ(dataset_in(disk_ / "dataset"), whole);
}

TEST_F(FullDisk, EndsAnExportWhichGoesOnWhenThereIsSpace) {
  const std::string dataset = (directory_ / "whole").string();
  ASSERT_EQ(generate(dataset).status, 0);
  const auto export_to = [&](const fs::path& out) {
    return run_program("export " + dataset + " --format numpy --jobs 2 --out " + out.string());
  };
  ASSERT_EQ(export_to(directory_ / "export").status, 0);
  const auto whole = files_below(directory_ / "export");

  write_bytes(disk_ / "other", std::string(900'000, 'x'));  // an export is smaller than the disk
  const ProgramResult full = export_to(disk_ / "export");
  EXPECT_EQ(full.status, 5);
  EXPECT_THAT(full.err, HasSubstr("No space left on device"));
  EXPECT_EQ(std::ranges::count(full.err, '\n'), 1) << full.err;
  const auto scenes = files_below(disk_ / "export/A1");
  EXPECT_LT(scenes.size(), 40U);
  for (const auto& [name, bytes] : scenes) EXPECT_EQ(bytes, whole.at("A1/" + name)) << name;

  ASSERT_TRUE(mount_with("size=64m", MS_REMOUNT));
  EXPECT_EQ(export_to(disk_ / "export").status, 0);
  EXPECT_EQ(files_below(disk_ / "export"), whole);
}

TEST_F(FullDisk, EndsAnExperimentWhichGoesOnWhenThereIsSpace) {
  const std::string dataset = (directory_ / "whole").string();
  ASSERT_EQ(generate(dataset).status, 0);
  // Labelled clouds are kept too: more than there is space for.
  const auto experiment = [&](const fs::path& out) {
    return run_program("experiment " + dataset + " --downsample 0.5,1 --keep --jobs 2 --out " + out.string());
  };
  ASSERT_EQ(experiment(directory_ / "results").status, 0);

  const ProgramResult full = experiment(disk_ / "results");
  EXPECT_EQ(full.status, 5);
  EXPECT_THAT(full.err, HasSubstr("No space left on device"));

  ASSERT_TRUE(mount_with("size=64m", MS_REMOUNT));
  const ProgramResult rest = experiment(disk_ / "results");
  EXPECT_EQ(rest.status, 0) << rest.err;
  for (const char* const file : {"results.csv", "tubes.csv"}) {
    EXPECT_EQ(bytes_of(disk_ / "results" / file), bytes_of(directory_ / "results" / file)) << file;
  }
}

// A file that may not be larger than so many blocks, as a cluster's limit has it.
TEST(FileSizeLimit, IsAnErrorAsAFullDiskIs) {
  const TemporaryDirectory directory;
  write_bytes(directory / "recipe.toml",
              test::recipe_text({.seed = 6, .width = 192, .tubes = "[1]", .cases = 1}));
  const ProgramResult result =
      test::run_shell("ulimit -f 4; " TANGLEBIN_PROGRAM " generate " + (directory / "recipe.toml").string() +
                      " --jobs 1 --out " + (directory / "dataset").string());
  EXPECT_EQ(result.status, 5);
  EXPECT_THAT(result.err, HasSubstr("cannot write: File too large"));
}

}  // namespace
}  // namespace tanglebin
