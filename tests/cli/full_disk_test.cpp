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

}  // namespace
}  // namespace tanglebin
