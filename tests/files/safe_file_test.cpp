#include "tanglebin/files/safe_file.hpp"

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "tanglebin/base/error.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/temporary_directory.hpp"

namespace tanglebin {
namespace {

using test::bytes_of;
using test::complaint;
namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

std::vector<std::string> names_in(const fs::path& directory) {
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(directory)) {
    names.push_back(entry.path().filename().string());
  }
  return names;
}

/// Each test has a directory of its own, gone afterwards.
class SafeFile : public testing::Test {
protected:
  test::TemporaryDirectory temporary_;
  fs::path directory_ = temporary_.path();
};

/// Files of this process cannot grow beyond `bytes`: what a full disk or a quota does, without being one.
class FileSizeLimit {
public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    static_cast<void>(std::signal(SIGXFSZ, handler_));
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

private:
  void (*handler_)(int);
  rlimit before_{};
};

TEST_F(SafeFile, HoldsTheBytesAndNothingIsBesideIt) {
  const std::string bytes("binary\0\n\r\xff", 10);
  write_file(directory_ / "1.ply", bytes);
  EXPECT_EQ(bytes_of(directory_ / "1.ply"), bytes);
  EXPECT_THAT(names_in(directory_), UnorderedElementsAre("1.ply"));
}

TEST_F(SafeFile, TakesThePlaceOfAnOlderOne) {
  write_file(directory_ / "1.ply", "a long old text");
  write_file(directory_ / "1.ply", "new");
  EXPECT_EQ(bytes_of(directory_ / "1.ply"), "new");
}

TEST_F(SafeFile, MayBeEmpty) {
  write_file(directory_ / "empty", "");
  EXPECT_TRUE(fs::is_empty(directory_ / "empty"));
}

TEST_F(SafeFile, HasThePermissionsOfAnyNewFile) {
  const mode_t umask_before = ::umask(027);
  write_file(directory_ / "1.ply", "x");
  ::umask(umask_before);
  EXPECT_EQ(fs::status(directory_ / "1.ply").permissions(), fs::perms{0640});
}

TEST_F(SafeFile, MayHaveTheLongestName) {
  const std::string name(255, 'n');
  write_file(directory_ / name, "x");
  EXPECT_EQ(bytes_of(directory_ / name), "x");
}

TEST_F(SafeFile, MayBeNamedWithoutADirectory) {
  const fs::path before = fs::current_path();
  fs::current_path(directory_);
  write_file("1.ply", "x");
  fs::current_path(before);
  EXPECT_EQ(bytes_of(directory_ / "1.ply"), "x");
}

TEST_F(SafeFile, ALinkStaysALink) {
  write_file(directory_ / "real", "old");
  fs::create_symlink("real", directory_ / "link");
  write_file(directory_ / "link", "new");
  EXPECT_TRUE(fs::is_symlink(directory_ / "link"));
  EXPECT_EQ(bytes_of(directory_ / "real"), "new");
}

TEST_F(SafeFile, APipeStaysAPipe) {
  const fs::path pipe = directory_ / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  std::string received;
  std::thread reader([&] { received = bytes_of(pipe); });
  write_file(pipe, "through");
  reader.join();
  EXPECT_EQ(received, "through");
  EXPECT_TRUE(fs::is_fifo(pipe));
}

TEST_F(SafeFile, AFullDeviceIsAnErrorThatSaysSo) {
  EXPECT_THAT(complaint([] { write_file("/dev/full", "x"); }),
              AllOf(HasSubstr("/dev/full"), HasSubstr("No space left on device")));
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST_F(SafeFile, ADiskThatFillsUpLeavesTheOldFileAndNothingElse) {
  write_file(directory_ / "1.ply", "old");
  const std::string bytes(100000, 'x');
  std::string error;
  {
    const FileSizeLimit limit(65536);
    error = complaint([&] { write_file(directory_ / "1.ply", bytes); });
  }
  EXPECT_THAT(error, AllOf(HasSubstr((directory_ / "1.ply").string()), HasSubstr("File too large")));
  EXPECT_EQ(bytes_of(directory_ / "1.ply"), "old");
  EXPECT_THAT(names_in(directory_), UnorderedElementsAre("1.ply"));
}

TEST_F(SafeFile, ADirectoryIsNotReplaced) {
  fs::create_directory(directory_ / "1.ply");
  EXPECT_THAT(complaint([&] { write_file(directory_ / "1.ply", "x"); }), HasSubstr("Is a directory"));
  EXPECT_TRUE(fs::is_directory(directory_ / "1.ply"));
  EXPECT_THAT(names_in(directory_), UnorderedElementsAre("1.ply"));
}

TEST_F(SafeFile, ADirectoryThatIsMissingOrAFileIsAnErrorThatSaysSo) {
  write_file(directory_ / "file", "x");
  EXPECT_THAT(complaint([&] { write_file(directory_ / "missing" / "1.ply", "x"); }),
              HasSubstr("No such file or directory"));
  EXPECT_THAT(complaint([&] { write_file(directory_ / "file" / "1.ply", "x"); }),
              HasSubstr("Not a directory"));
  EXPECT_THAT(names_in(directory_), UnorderedElementsAre("file"));
}

// Not even root may make files there.
TEST_F(SafeFile, ADirectoryThatTakesNoFilesIsAnErrorThatSaysSo) {
  EXPECT_THAT(complaint([] { write_file("/proc/self/fdinfo/1.ply", "x"); }),
              AllOf(HasSubstr("/proc/self/fdinfo/1.ply: cannot write: ")));
}

TEST_F(SafeFile, AWrongPathIsBadInputAndAFullDeviceARefusalOfTheSystem) {
  EXPECT_THROW(write_file(directory_ / "missing" / "1.ply", "x"), InputError);
  EXPECT_THROW(write_file("/dev/full", "x"), SystemError);
}

TEST_F(SafeFile, SeveralAreWrittenOrNoneIs) {
  write_file(directory_ / "1.ply", "old");
  write_file(directory_ / "target", "old");
  fs::create_symlink("target", directory_ / "link");
  fs::create_directory(directory_ / "folder");
  const std::string bytes(100000, 'x');
  const std::vector<fs::path> refused = {directory_ / "missing" / "1.png", directory_ / "folder",
                                         "/dev/full"};
  for (const fs::path& file : refused) {
    EXPECT_THAT(complaint([&] {
                  write_files({{directory_ / "1.ply", "new"}, {file, "new"}});
                }),
                HasSubstr(file.string() + ": cannot write: "));
  }
  {
    const FileSizeLimit limit(65536);
    EXPECT_THAT(complaint([&] {
                  write_files({{directory_ / "1.ply", "new"}, {directory_ / "2.ply", bytes}});
                }),
                HasSubstr("2.ply: cannot write: File too large"));
  }
  EXPECT_EQ(bytes_of(directory_ / "1.ply"), "old");
  EXPECT_THAT(names_in(directory_), UnorderedElementsAre("1.ply", "target", "link", "folder"));

  write_files({{directory_ / "1.ply", "new"}, {directory_ / "link", "new"}, {"/dev/null", "new"}});
  EXPECT_EQ(bytes_of(directory_ / "1.ply"), "new");
  EXPECT_EQ(bytes_of(directory_ / "target"), "new");
  EXPECT_TRUE(fs::is_symlink(directory_ / "link"));
  EXPECT_THAT(names_in(directory_), UnorderedElementsAre("1.ply", "target", "link", "folder"));
}

TEST_F(SafeFile, ManyWritersOfOneFileEachWriteAWholeOne) {
  const fs::path file = directory_ / "1.ply";
  std::vector<std::thread> writers;
  for (char letter = 'a'; letter < 'i'; ++letter) {
    writers.emplace_back([&file, letter] {
      for (int i = 0; i < 20; ++i) write_file(file, std::string(10000, letter));
    });
  }
  for (int i = 0; i < 100; ++i) {
    const std::string seen = bytes_of(file);
    if (seen.empty()) continue;  // not yet there
    ASSERT_EQ(seen, std::string(10000, seen.front()));
  }
  for (std::thread& writer : writers) writer.join();
  EXPECT_EQ(bytes_of(file).size(), 10000U);
  EXPECT_THAT(names_in(directory_), UnorderedElementsAre("1.ply"));
}

TEST_F(SafeFile, WhatAKilledProcessLeftIsNotTouched) {
  std::vector<std::string> left;
  for (int i = 0; i < 1000; ++i) {
    left.push_back(fmt::format(".tanglebin-{}-{}.tmp", ::getpid(), i));
    std::ofstream(directory_ / left.back()) << "half";
  }
  write_file(directory_ / "1.ply", "whole");
  EXPECT_EQ(bytes_of(directory_ / "1.ply"), "whole");
  for (const std::string& name : left) EXPECT_EQ(bytes_of(directory_ / name), "half");
}

TEST_F(SafeFile, StagedTakesItsNameWhenItIsCommittedAndNotBefore) {
  fs::create_directory(directory_ / "staging");
  {
    StagedFile file(directory_ / "1.ply", directory_ / "staging");
    file.append("one ");
    file.append("file");
    EXPECT_FALSE(fs::exists(directory_ / "1.ply"));
    file.commit();
  }
  EXPECT_EQ(bytes_of(directory_ / "1.ply"), "one file");
  EXPECT_THAT(names_in(directory_ / "staging"), IsEmpty());
}

TEST_F(SafeFile, StagedIsGoneWhereItIsNotCommitted) {
  write_file(directory_ / "1.ply", "old");
  fs::create_directory(directory_ / "staging");
  { StagedFile(directory_ / "1.ply", directory_ / "staging").append("new"); }
  EXPECT_EQ(bytes_of(directory_ / "1.ply"), "old");
  EXPECT_THAT(names_in(directory_ / "staging"), IsEmpty());
}

TEST_F(SafeFile, StagedSaysWhatItIsThatCannotBeWritten) {
  EXPECT_THAT(complaint([&] { write_staged(directory_ / "1.ply", "x", directory_ / "none"); }),
              AllOf(HasSubstr((directory_ / "1.ply").string()), HasSubstr("No such file or directory")));
  const FileSizeLimit limit(10);
  EXPECT_THAT(complaint([&] { write_staged(directory_ / "1.ply", std::string(100, 'x'), directory_); }),
              HasSubstr("1.ply: cannot write: File too large"));
  EXPECT_THAT(names_in(directory_), IsEmpty());
}

TEST_F(SafeFile, AFolderThatALinkLeadsOutOfTheDirectoryIsFoundBeforeItIsMade) {
  fs::create_directories(directory_ / "dataset" / "A1");
  fs::create_directory(directory_ / "elsewhere");
  fs::create_symlink("../elsewhere", directory_ / "dataset" / "A2");
  const auto check = [&](const fs::path& file) {
    return complaint([&] { expect_below(directory_ / "dataset", directory_ / "dataset" / file); });
  };
  EXPECT_EQ(check("A1/plys/1.ply"), "none");
  EXPECT_EQ(check("A3/plys/1.ply"), "none");
  EXPECT_THAT(check("A2/plys/1.ply"), HasSubstr("expected a folder below the dataset's directory"));
}

using MakeDirectories = SafeFile;

TEST_F(MakeDirectories, MakesAllThatAreMissing) {
  make_directories(directory_ / "A10" / "plys");
  make_directories(directory_ / "A10" / "plys");
  make_directories(directory_ / "A10" / "labels" / "");
  EXPECT_THAT(names_in(directory_ / "A10"), UnorderedElementsAre("plys", "labels"));
}

TEST_F(MakeDirectories, NamesTheFileInTheWay) {
  write_file(directory_ / "A10", "a file");
  const std::string expected = (directory_ / "A10").string() + ": found a file, expected a directory";
  EXPECT_EQ(complaint([&] { make_directories(directory_ / "A10" / "plys" / "x"); }), expected);
  EXPECT_EQ(complaint([&] { make_directories(directory_ / "A10"); }), expected);
}

TEST_F(MakeDirectories, SaysWhyTheyCannotBeMade) {
  EXPECT_THAT(complaint([] { make_directories("/proc/self/fdinfo/A10/plys"); }),
              AllOf(HasSubstr("/proc/self/fdinfo/A10/plys"), HasSubstr("cannot make the directory: ")));
}

}  // namespace
}  // namespace tanglebin
