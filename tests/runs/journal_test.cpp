#include "tanglebin/runs/journal.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tanglebin/base/error.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/temporary_directory.hpp"

namespace tanglebin {
namespace {

using test::bytes_of;
using test::complaint;
using test::files_below;
using test::TemporaryDirectory;
using test::write_bytes;
using testing::ElementsAre;

TEST(FileLock, KeepsOthersOutUntilItIsGone) {
  const TemporaryDirectory directory;
  {
    const auto first = FileLock::take(directory / "file");
    ASSERT_TRUE(first);
    EXPECT_FALSE(FileLock::take(directory / "file"));
  }
  EXPECT_TRUE(FileLock::take(directory / "file"));
}

TEST(FileLock, IsHeldByForkedProcessesToo) {
  const TemporaryDirectory directory;
  pid_t child = 0;
  {
    const auto lock = FileLock::take(directory / "file");
    child = fork();
    if (child == 0) {
      pause();
      _exit(0);
    }
  }
  EXPECT_FALSE(FileLock::take(directory / "file"));
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  EXPECT_TRUE(FileLock::take(directory / "file"));
}

TEST(FileLock, OfAFileThatWasRemovedMeanwhileIsOfTheNewFile) {
  const TemporaryDirectory directory;
  const auto old = FileLock::take(directory / "file");
  std::filesystem::remove(directory / "file");
  const auto lock = FileLock::take(directory / "file");
  ASSERT_TRUE(lock);
  EXPECT_FALSE(FileLock::take(directory / "file"));
}

// Another process that takes the directory's lock and leaves a file when it has it. `held` is this process's.
template <typename Lock, typename Held>
pid_t start_locking(const TemporaryDirectory& directory, std::optional<Held>& held) {
  const pid_t other = fork();
  if (other != 0) return other;
  held.reset();  // the other process's copy
  const Lock lock(directory.path());
  write_bytes(directory / "locked", "");
  _exit(0);
}

template <typename Lock, typename Held>
void expect_to_wait(const TemporaryDirectory& directory) {
  std::optional<Held> held(std::in_place, directory.path());
  const pid_t other = start_locking<Lock>(directory, held);
  usleep(50'000);
  EXPECT_FALSE(std::filesystem::exists(directory / "locked"));
  held.reset();
  waitpid(other, nullptr, 0);
  EXPECT_TRUE(std::filesystem::remove(directory / "locked"));
}

TEST(DirectoryLock, KeepsOthersWaitingAndItsFileStays) {
  const TemporaryDirectory directory;
  expect_to_wait<DirectoryLock, DirectoryLock>(directory);
  expect_to_wait<DirectoryReadLock, DirectoryLock>(directory);
  expect_to_wait<DirectoryLock, DirectoryReadLock>(directory);
  EXPECT_TRUE(std::filesystem::exists(directory / ".lock"));
}

TEST(DirectoryLock, LetsReadersInTogether) {
  const TemporaryDirectory directory;
  { const DirectoryLock creates_the_file(directory.path()); }
  std::optional<DirectoryReadLock> held(std::in_place, directory.path());
  waitpid(start_locking<DirectoryReadLock>(directory, held), nullptr, 0);
  EXPECT_TRUE(std::filesystem::exists(directory / "locked"));
}

TEST(DirectoryLock, OfReadersCreatesNothing) {
  const TemporaryDirectory directory;
  const DirectoryReadLock lock(directory.path());
  EXPECT_TRUE(std::filesystem::is_empty(directory.path()));
}

TEST(Journal, HasALineForEachTaskAndIsGoneWhenItIsEmpty) {
  const TemporaryDirectory directory;
  {
    const Journal journal(directory.path());
    journal.append({"one", "two"});
    journal.append({"three"});
    EXPECT_EQ(bytes_of(directory / "journal.jsonl"), "one\ntwo\nthree\n");
    journal.clear();
  }
  EXPECT_EQ(files_below(directory.path()), (std::map<std::string, std::string>{{".lock", ""}}));
}

TEST(Journal, KeepsItsLinesWhereTheyWereNotMovedElsewhere) {
  const TemporaryDirectory directory;
  {
    const Journal journal(directory.path(), "2-of-8");
    journal.append({"one"});
  }
  EXPECT_EQ(files_below(directory.path()),
            (std::map<std::string, std::string>{{".lock", ""}, {"journal-2-of-8.jsonl", "one\n"}}));
  const Journal again(directory.path(), "2-of-8");
  again.append({"two"});
  EXPECT_EQ(bytes_of(directory / "journal-2-of-8.jsonl"), "one\ntwo\n");
}

TEST(Journal, HasAPlaceForUnfinishedFilesThatStartsEmpty) {
  const TemporaryDirectory directory;
  std::filesystem::create_directory(directory / ".journal.unfinished");
  write_bytes(directory / ".journal.unfinished/half", "left by a run that was killed");
  const Journal journal(directory.path());
  EXPECT_TRUE(std::filesystem::is_directory(journal.staging()));
  EXPECT_TRUE(std::filesystem::is_empty(journal.staging()));
}

TEST(Journal, IsOfOneRunAtATimeButRunsOfOtherNamesAreWelcome) {
  const TemporaryDirectory directory;
  const Journal first(directory.path());
  const Journal second(directory.path(), "2-of-2");
  EXPECT_EQ(complaint([&] { Journal(directory.path()); }),
            directory.path().string() + ": another run is writing here");
}

TEST(Journal, IsInUseUntilItsRunEndsAndCanThenBeRemoved) {
  const TemporaryDirectory directory;
  const std::filesystem::path ended = directory / "journal-1-of-3.jsonl";
  write_bytes(ended, "one\ntorn");
  std::filesystem::create_directory(directory / ".journal-1-of-3.unfinished");
  const Journal running(directory.path(), "2-of-3");
  running.append({"two"});
  EXPECT_THAT(journals_in(directory.path()), ElementsAre(ended, running.file()));
  EXPECT_THAT(journals_in_use(journals_in(directory.path())), ElementsAre(running.file()));
  remove_journal(ended);
  EXPECT_THAT(journals_in(directory.path()), ElementsAre(running.file()));
  EXPECT_FALSE(std::filesystem::exists(directory / ".journal-1-of-3.unfinished"));
}

TEST(Journal, ALastLineThatWasCutOffIsPassedOver) {
  const TemporaryDirectory directory;
  write_bytes(directory / "journal.jsonl", "one\ntwo\nthr");
  std::vector<std::string> lines;
  for_each_whole_line(directory / "journal.jsonl", [&](const std::string& line, std::size_t number) {
    lines.push_back(line + std::to_string(number));
  });
  EXPECT_THAT(lines, ElementsAre("one1", "two2"));
  for_each_whole_line(directory / "none", [](const std::string&, std::size_t) { FAIL(); });
}

TEST(Journal, OfARunWithANameIsWaitedForAsLongAsAFileServerMayKeepIt) {
  const TemporaryDirectory directory;
  const pid_t other = fork();
  if (other == 0) {
    const Journal journal(directory.path(), "1-of-2");
    journal.append({"one"});
    sleep(4);
    _exit(0);
  }
  while (bytes_of(directory / "journal-1-of-2.jsonl").empty()) usleep(1000);
  const Journal journal(directory.path(), "1-of-2");
  EXPECT_EQ(bytes_of(directory / "journal-1-of-2.jsonl"), "one\n");
  waitpid(other, nullptr, 0);
}

TEST(Journal, BeginsANewLineWhereOneWasTorn) {
  const TemporaryDirectory directory;
  write_bytes(directory / "journal.jsonl", "one\nto");
  {
    const Journal journal(directory.path());
    journal.append({"two"});
    EXPECT_EQ(bytes_of(directory / "journal.jsonl"), "one\ntwo\n");
  }
  write_bytes(directory / "journal.jsonl", "torn");
  const Journal journal(directory.path());
  EXPECT_EQ(bytes_of(directory / "journal.jsonl"), "");
}

TEST(Journal, IsNoOtherFileOfTheUsers) {
  const TemporaryDirectory directory;
  write_bytes(directory / "precious", "of the user");
  write_bytes(directory / "journal of mine.jsonl", "of the user");
  std::filesystem::create_symlink("precious", directory / "journal-x.jsonl");
  EXPECT_THAT(journals_in(directory.path()), ElementsAre());
  EXPECT_THAT(complaint([&] { Journal(directory.path(), "x"); }),
              testing::HasSubstr("journal-x.jsonl: cannot be locked: Too many levels of symbolic links"));
  EXPECT_EQ(bytes_of(directory / "precious"), "of the user");
}

TEST(Journal, LinesThatCannotBeReadArePassedOver) {
  const TemporaryDirectory directory;
  write_bytes(directory / "journal.jsonl", "one\ntwo\nthree\n");
  std::vector<std::string> lines;
  for_each_readable_line(directory / "journal.jsonl", [&](const std::string& line, std::size_t) {
    if (line == "two") throw InputError({}, "damaged");
    lines.push_back(line);
  });
  EXPECT_THAT(lines, ElementsAre("one", "three"));
}

TEST(Lines, OfAFileThatIsThereButCannotBeReadAreAnError) {
  const TemporaryDirectory directory;
  const auto read = [&] { for_each_whole_line(directory / "file", [](const std::string&, std::size_t) {}); };
  std::filesystem::create_symlink("file", directory / "file");
  EXPECT_EQ(complaint(read),
            (directory / "file").string() + ": cannot be opened: Too many levels of symbolic links");
  std::filesystem::remove(directory / "file");
  std::filesystem::create_directory(directory / "file");
  EXPECT_EQ(complaint(read), (directory / "file").string() + ": found a directory, expected a regular file");
}

}  // namespace
}  // namespace tanglebin
