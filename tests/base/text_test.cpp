#include "tanglebin/base/text.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <string>

#include "tanglebin/base/error.hpp"

namespace tanglebin {
namespace {

TEST(Printable, LeavesTextAsItIs) {
  EXPECT_EQ(printable("/data/Röhren – 管 🙂/1.ply: found -3"),
            "/data/Röhren – 管 🙂/1.ply: found -3");
  EXPECT_EQ(printable(""), "");
}

TEST(Printable, EscapesWhatATerminalObeys) {
  EXPECT_EQ(printable("\x1b[2Ja\nb\tc\r\x7f"), "\\x1b[2Ja\\nb\\tc\\x0d\\x7f");
  EXPECT_EQ(printable(std::string("a\0b", 3)), "a\\x00b");
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m"),
            "\\xc2\\x9b31m")
      << "CSI in eight bits";
}

TEST(Printable, EscapesBytesThatAreNotUtf8) {
  EXPECT_EQ(printable("a\xff"
                      "b"),
            "a\\xffb");
  EXPECT_EQ(printable("\xc3"), "\\xc3") << "cut off";
  EXPECT_EQ(printable("\xc0\x8a"), "\\xc0\\x8a") << "a line feed in too many bytes";
  EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80") << "half of a pair";
}

RC_GTEST_PROP(Printable, OfAnyBytesHasNoControlCharacterAndStaysAsItIs, (const std::string& bytes)) {
  const std::string shown = printable(bytes);
  RC_ASSERT(std::ranges::none_of(shown, [](char c) { return (c >= 0 && c < ' ') || c == 0x7f; }));
  RC_ASSERT(printable(shown) == shown);
}

TEST(Excerpt, IsQuotedAndCutAfterFortyCharacters) {
  EXPECT_EQ(excerpt("Röhren – 管 🙂"), "'Röhren – 管 🙂'");
  EXPECT_EQ(excerpt("a\n\xe9\xc2\x9b"), "'a\\x0a\\xe9\\xc2\\x9b'");
  EXPECT_EQ(excerpt(std::string(40, 'x')), "'" + std::string(40, 'x') + "'");
  EXPECT_EQ(excerpt(std::string(39, 'x') + "öy"), "'" + std::string(39, 'x') + "ö…'");
}

TEST(InputError, ShowsNamesPrintable) {
  const InputError error({"a\x1b[2J\n.ply", 0, ""}, "is missing");
  EXPECT_STREQ(error.what(), "a\\x1b[2J\\n.ply: is missing");
  EXPECT_EQ(error.place().file, "a\x1b[2J\n.ply");
  EXPECT_STREQ(SystemError("a\n", "full").what(), "a\\n: full");
}

}  // namespace
}  // namespace tanglebin
