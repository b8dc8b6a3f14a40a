#pragma once

#include <string>
#include <string_view>
#include <vector>

// Pieces of HTML. What is called `html` is HTML already; all other text is escaped here.
namespace tanglebin {

/// Text as it may stand in an element or in a quoted attribute.
std::string escaped(std::string_view text);

std::string base64(std::string_view bytes);

/// A column of a table. Neighbours of the same group, unless it is empty, stand below a common heading.
struct HtmlColumn {
  std::string heading;
  std::string group;
  bool is_published = false;  ///< the paper's numbers
};

/// A table of text. The first cell of a row is its heading.
struct HtmlTable {
  std::string caption_html;
  std::vector<HtmlColumn> columns;
  std::vector<std::vector<std::string>> rows;  ///< a cell for each column
};

/// A <figure> with the table in a box of its own, in which a wide one scrolls.
std::string html(const HtmlTable& table);

/// <p> of a class: "note" for what readers should know, "missing" for what the page lacks.
std::string paragraph(std::string_view css_class, std::string_view text_html);

}  // namespace tanglebin
