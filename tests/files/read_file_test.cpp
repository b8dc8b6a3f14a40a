#include "tanglebin/files/read_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <sstream>
#include <string>
#include <vector>

#include "tests/support/complaint.hpp"
#include "tests/support/temporary_directory.hpp"

namespace tanglebin {
namespace {

using test::complaint;
using test::TemporaryDirectory;
using test::write_bytes;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(ReadFile, IsAllOfARegularFileOrNoneIfItIsMissing) {
  const TemporaryDirectory directory;
  const std::string bytes(200000, 'x');
  write_bytes(directory / "file", bytes);
  EXPECT_EQ(read_file(directory / "file"), bytes);
  EXPECT_EQ(read_if_there(directory / "none"), std::nullopt);
  EXPECT_THAT(complaint([&] { read_file(directory / "none"); }),
              HasSubstr("none: cannot be opened: No such"));
}

TEST(ReadFile, NeitherWaitsForAPipeNorReadsADeviceOrADirectory) {
  const TemporaryDirectory directory;
  ASSERT_EQ(mkfifo((directory / "pipe").c_str(), 0600), 0);
  std::filesystem::create_symlink("/dev/zero", directory / "zero");
  const auto of = [&](const std::string& name) { return complaint([&] { read_file(directory / name); }); };
  EXPECT_THAT(of("pipe"), HasSubstr("pipe: found a pipe, expected a regular file"));
  EXPECT_THAT(of("zero"), HasSubstr("zero: found a device, expected a regular file"));
  EXPECT_THAT(of(""), HasSubstr("found a directory, expected a regular file"));
}

TEST(ReadFile, AnInputIsNoDirectory) {
  const TemporaryDirectory directory;
  write_bytes(directory / "file", "tubes");
  std::string word;
  open_input(directory / "file") >> word;
  EXPECT_EQ(word, "tubes");
  EXPECT_THAT(complaint([&] { open_input(directory.path()); }), HasSubstr(": is a directory"));
  EXPECT_THAT(complaint([&] { open_input(directory / "none"); }),
              HasSubstr("none: cannot be opened: No such"));
}

TEST(ReadFile, OfAFileThatIsTooLargeIsAnErrorThatDoesNotReadItAll) {
  const TemporaryDirectory directory;
  write_bytes(directory / "file", "");
  std::filesystem::resize_file(directory / "file", std::uintmax_t{1} << 40U);
  EXPECT_THAT(complaint([&] { read_file(directory / "file"); }),
              HasSubstr("file: found more bytes, expected at most 16777216"));
  write_bytes(directory / "four", "four");
  EXPECT_EQ(read_file(directory / "four", 4), "four");
  EXPECT_THAT(complaint([&] { read_file(directory / "four", 3); }), HasSubstr("expected at most 3"));
}

TEST(EachLine, HasItsNumberAndSaysWhetherItIsWhole) {
  const TemporaryDirectory directory;
  write_bytes(directory / "file", "one\n\nthree");
  std::vector<std::string> lines;
  for_each_line(directory / "file", [&](const FileLine& line) {
    lines.push_back(std::to_string(line.number) + line.text + (line.is_whole ? "!" : "?"));
  });
  EXPECT_THAT(lines, ElementsAre("1one!", "2!", "3three?"));
  for_each_line(directory / "none", [](const FileLine&) { FAIL(); });
}

TEST(EachLine, ThatIsEndlessIsAnErrorThatNamesIt) {
  const TemporaryDirectory directory;
  write_bytes(directory / "file", "one\n");
  std::filesystem::resize_file(directory / "file", std::uintmax_t{1} << 40U);
  std::size_t lines = 0;
  EXPECT_THAT(complaint([&] { for_each_line(directory / "file", [&](const FileLine&) { ++lines; }); }),
              HasSubstr("file:2: found a line of 67108864 bytes or more, expected a shorter one"));
  EXPECT_EQ(lines, 1U);
}

}  // namespace
}  // namespace tanglebin
