#pragma once

#include <string>
#include <string_view>
#include <vector>

// Building blocks of HTML. Arguments called `html` are HTML already; all other text is escaped here.
namespace tanglebin {

/// Escapes text for use in an element or a quoted attribute.
std::string escaped(std::string_view text);

std::string base64(std::string_view bytes);

/// A column of a table. Neighbours with the same nonempty group share a heading above their own.
struct HtmlColumn {
  std::string heading;
  std::string group;
  bool is_published = false;  ///< numbers from the paper
};

/// A table of text. The first cell of each row is its heading.
struct HtmlTable {
  std::string caption_html;
  std::vector<HtmlColumn> columns;
  std::vector<std::vector<std::string>> rows;  ///< one cell per column
};

/// A <figure> with the table in a box that scrolls if the table is wide.
std::string html(const HtmlTable& table);

/// A <p> with a class: "note" for remarks, "missing" for what the page lacks.
std::string paragraph(std::string_view css_class, std::string_view text_html);

}  // namespace tanglebin
