#include "tanglebin/experiment/entry.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <string>
#include <vector>

#include "tanglebin/dataset/sha256.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/temporary_directory.hpp"

namespace tanglebin {
namespace {

using test::complaint;
using test::TemporaryDirectory;
using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::string> arguments_of(const std::string& text) {
  std::vector<std::string> words = command_of("true " + text + " {cloud} {out}", "/nowhere").words;
  return {words.begin() + 1, words.end() - 2};
}

TEST(Command, IsSplitIntoWordsAndNothingIsExpanded) {
  EXPECT_THAT(arguments_of("a  b\tc"), ElementsAre("a", "b", "c"));
  EXPECT_THAT(arguments_of("'a  b' \"c d\" e' 'f ''"), ElementsAre("a  b", "c d", "e f", ""));
  EXPECT_THAT(arguments_of(R"(a\ b 'c\d' "e\"f" \')"), ElementsAre("a b", R"(c\d)", "e\"f", "'"));
  EXPECT_THAT(arguments_of("$HOME *.ply `id` ~ a|b >c"),
              ElementsAre("$HOME", "*.ply", "`id`", "~", "a|b", ">c"));
}

RC_GTEST_PROP(Command, AnyWordCanBeQuoted, (const std::string& word)) {
  std::string quoted = "'";
  for (const char character : word) {
    quoted += character == '\'' ? std::string(R"('\'')") : std::string(1, character);
  }
  RC_PRE(word.find('\0') == std::string::npos && word.find('/') == std::string::npos);
  RC_PRE(word != "." && word != "..");
  RC_ASSERT(arguments_of(quoted + "'") == std::vector<std::string>{word});
}

TEST(Command, WordsThatNameFilesAreFoundFromWhereItWasGivenAndTheirBytesBelongToIt) {
  const TemporaryDirectory directory;
  test::write_bytes(directory / "segment.py", "print()\n");
  const Command command =
      command_of("sh segment.py --weights=segment.py none.py {cloud} {out.npy}", directory.path());
  const std::string script = (directory / "segment.py").string();
  EXPECT_THAT(command.words, ElementsAre(HasSubstr("/sh"), script, "--weights=segment.py", "none.py",
                                         "{cloud}", "{out.npy}"));
  EXPECT_EQ(command.sha256.at(script), sha256("print()\n"));
  EXPECT_TRUE(command.sha256.contains(command.words.front()));
}

TEST(Command, SaysWhatIsWrongWithIt) {
  const auto complaint_about = [](const std::string& text) {
    return complaint([&] { command_of(text, "/nowhere"); });
  };
  EXPECT_THAT(complaint_about("no-such-program {cloud} {out}"),
              HasSubstr("--method: found 'no-such-program', expected a program that is installed"));
  EXPECT_THAT(complaint_about("true {out}"), HasSubstr("{cloud}, the cloud to label"));
  EXPECT_THAT(complaint_about("true {cloud}"), HasSubstr("{out} or {tubes}, the file to write"));
  EXPECT_THAT(complaint_about(""), HasSubstr("{cloud}"));
  EXPECT_THAT(complaint_about("true 'open {cloud} {out}"), HasSubstr("the end of the command"));
}

TEST(Entries, HaveNamesThatCanBePartsOfFileNames) {
  const auto complaint_about = [](const std::vector<std::string>& names) {
    std::vector<Entry> entries = {entry_of(Method::axis)};
    for (const std::string& name : names) entries.push_back({name, LabelsDirectory{"labels"}});
    return complaint([&] { expect_names(entries); });
  };
  EXPECT_EQ(complaint_about({"mine", "mine-2.0_b"}), "none");
  for (const char* name : {"", "..", "a/b", "a b", "-a", "é"})
    EXPECT_THAT(complaint_about({name}), HasSubstr("a name of letters, digits")) << name;
  EXPECT_THAT(complaint_about({"mine", "mine"}), HasSubstr("--labels: found mine twice"));
  EXPECT_THAT(complaint_about({"paper"}), HasSubstr("another name than that of a built-in method"));
}

}  // namespace
}  // namespace tanglebin
