#include "tanglebin/files/toml_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/support/complaint.hpp"

namespace tanglebin {
namespace {

using test::complaint;

std::string repeated(std::size_t times, const std::string& text) {
  std::string result;
  for (std::size_t i = 0; i < times; ++i) result += text;
  return result;
}

std::string complaint_about(const std::string& text) {
  return complaint([&] { parse_toml(text, "r.toml"); });
}

const std::string too_deep = "found TOML nested too deep, expected at most 64 levels";

TEST(ParseToml, MayBeNestedSixtyFourDeep) {
  EXPECT_EQ(complaint_about(repeated(64, "a.") + "a = 1"), "none");
  EXPECT_EQ(complaint_about("a = " + repeated(64, "[") + repeated(64, "]")), "none");
  EXPECT_EQ(complaint_about("a = " + repeated(64, "{ b = ") + "1" + repeated(64, " }")), "none");
  EXPECT_EQ(complaint_about("[" + repeated(63, "a.") + "a]\nb = 1"), "none");
}

TEST(ParseToml, NestedDeeperIsAnErrorHoweverDeepItIs) {
  for (const std::size_t levels : {65U, 400000U}) {
    EXPECT_EQ(complaint_about("b = 1\n" + repeated(levels, "a.") + "a = 1"), "r.toml:2: " + too_deep);
    EXPECT_EQ(complaint_about(repeated(levels, "\"a\" . ") + "a = 1"), "r.toml:1: " + too_deep);
    EXPECT_EQ(complaint_about("[" + repeated(levels, "a.") + "a]"), "r.toml:1: " + too_deep);
    EXPECT_EQ(complaint_about("a = " + repeated(levels, "[")), "r.toml:1: " + too_deep);
    EXPECT_EQ(complaint_about("a = " + repeated(levels, "{ b = ")), "r.toml:1: " + too_deep);
  }
}

TEST(ParseToml, AddsUpWhatIsNestedInAHeaderInBracketsAndInKeys) {
  const std::string forty_levels = repeated(40, "a.") + "a";
  EXPECT_EQ(complaint_about("[" + forty_levels + "]\n" + forty_levels + " = 1"), "r.toml:2: " + too_deep);
  EXPECT_EQ(complaint_about(forty_levels + " = { " + forty_levels + " = 1 }"), "r.toml:1: " + too_deep);
  EXPECT_EQ(complaint_about("[" + forty_levels + "]\n  [b]\n" + forty_levels + " = 1"), "none");
  EXPECT_EQ(complaint_about("x = { " + forty_levels + " = 1, b" + forty_levels + " = 1 }"), "none");
}

TEST(ParseToml, CountsNoDotsAndBracketsOfStringsCommentsAndNumbers) {
  const std::string many = repeated(100, "[.{");
  EXPECT_EQ(complaint_about("a = \"" + many + "\\\"" + many + "\" # " + many), "none");
  EXPECT_EQ(complaint_about("a = '" + many + "\\'\nb = \"\"\"" + many + "\n\\\"\"\"" + many + "\"\"\"\"\""),
            "none");
  EXPECT_EQ(complaint_about("a = [" + repeated(100, "1.5,\n") + "]"), "none");
  EXPECT_EQ(complaint_about("x = { a = \"\"\"\"\"\"\"\", b." + repeated(100, "c.") + "d = 1 }"),
            "r.toml:1: " + too_deep)
      << "the string has ended";
}

TEST(ParseToml, KeepsStringsAsTheyAre) {
  EXPECT_EQ(parse_toml("file = \"größe–管.json\"  # größer", "r.toml")["file"].value<std::string>(),
            "größe–管.json");
  EXPECT_EQ(parse_toml("file = \"\\\\ö\\\"🙂\"", "r.toml")["file"].value<std::string>(), "\\ö\"🙂");
  EXPECT_EQ(parse_toml("file = 'C:\\größe\"'", "r.toml")["file"].value<std::string>(), "C:\\größe\"");
  EXPECT_EQ(parse_toml("file = '''größe'''", "r.toml")["file"].value<std::string>(), "größe");
  EXPECT_EQ(parse_toml("a = 1  # gr\xf6\xdf", "r.toml")["a"].value<int>(), 1) << "Latin-1";
}

TEST(ParseToml, ShowsKeysThatAreNotAscii) {
  EXPECT_EQ(complaint_about("a = 1\n[b]\ngröße = 2"),
            "r.toml:3: found 'größe', expected ASCII, except in strings and comments");
  EXPECT_EQ(complaint_about("a = – 1"),
            "r.toml:1: found '–', expected ASCII, except in strings and comments");
  const toml::table tree = parse_toml("\"größe\" = 2", "r.toml");
  const TomlSource source("r.toml", tree);
  EXPECT_EQ(complaint([&] { TomlTable(source, tree, "").allow({"radius"}); }),
            "r.toml:1: unknown key 'größe', expected one of radius");
}

TEST(ParseToml, RejectsStringsThatAreNotUtf8) {
  EXPECT_EQ(complaint_about("b = 1\na = \"gr\xf6\xdf\""), "r.toml:2: found 'gr\\xf6\\xdf', expected UTF-8");
  EXPECT_EQ(complaint_about("a = '\xed\xa0\x80'"), "r.toml:1: found '\\xed\\xa0\\x80', expected UTF-8")
      << "half of a pair";
}

TEST(ParseToml, RejectsCharactersInTheWrongPlaceOfAString) {
  EXPECT_THAT(complaint_about("a = \"\\ö\""), testing::HasSubstr("r.toml:1: "));
  EXPECT_THAT(complaint_about("a = x\"ö\""), testing::HasSubstr("r.toml:1: "));
  EXPECT_THAT(complaint_about("a = \"ö"), testing::HasSubstr("r.toml:1: "));
}

}  // namespace
}  // namespace tanglebin
