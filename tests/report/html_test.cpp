#include "tanglebin/report/html.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tanglebin {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(Html, TextCannotBecomeMarkup) {
  EXPECT_EQ(escaped(R"(<b class="x">'A' & B</b>)"),
            "&lt;b class=&quot;x&quot;&gt;&#39;A&#39; &amp; B&lt;/b&gt;");
}

// RFC 4648, Section 10.
TEST(Html, Base64IsThatOfTheStandard) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64(std::string("\0\xff", 2)), "AP8=");
}

TEST(Html, CellsAndHeadingsOfATableAreEscaped) {
  const std::string text =
      html({.caption_html = "<b>bold</b>",
            .columns = {{.heading = "<h>", .group = ""}, {.heading = "x", .group = "<g>"}},
            .rows = {{"<r>", "<c>"}}});
  EXPECT_THAT(text, HasSubstr("<b>bold</b>"));
  for (const char* name : {"h", "g", "r", "c"}) {
    EXPECT_THAT(text, HasSubstr(std::string("&lt;") + name + "&gt;"));
    EXPECT_THAT(text, Not(HasSubstr(std::string("<") + name + ">")));
  }
}

TEST(Html, ColumnsOfAGroupStandBelowOneHeading) {
  const std::string text = html({.caption_html = "",
                                 .columns = {{.heading = "n", .group = ""},
                                             {.heading = "a", .group = "A"},
                                             {.heading = "b", .group = "A", .is_published = true}},
                                 .rows = {{"1", "2", "3"}}});
  EXPECT_THAT(text,
              HasSubstr(R"(<th scope="col" rowspan="2">n</th><th scope="colgroup" colspan="2">A</th>)"));
  EXPECT_THAT(text, HasSubstr(R"(<th scope="col">a</th><th scope="col" class="published">b</th>)"));
  EXPECT_THAT(text, HasSubstr(R"(<th scope="row">1</th><td>2</td><td class="published">3</td>)"));
}

}  // namespace
}  // namespace tanglebin
