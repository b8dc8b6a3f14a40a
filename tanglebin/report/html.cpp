#include "tanglebin/report/html.hpp"

#include <fmt/format.h>
#include <openssl/evp.h>

namespace tanglebin {
namespace {

/// The number of columns in the group of column `first`, from there on.
std::size_t group_size(const std::vector<HtmlColumn>& columns, std::size_t first) {
  std::size_t end = first;
  while (end < columns.size() && columns[end].group == columns[first].group) ++end;
  return end - first;
}

std::string group_headings(const std::vector<HtmlColumn>& columns) {
  std::string html = "<tr>";
  for (std::size_t i = 0; i < columns.size();) {
    if (columns[i].group.empty()) {
      html += fmt::format("<th scope=\"col\" rowspan=\"2\">{}</th>", escaped(columns[i].heading));
      ++i;
      continue;
    }
    const std::size_t size = group_size(columns, i);
    html += fmt::format("<th scope=\"colgroup\" colspan=\"{}\">{}</th>", size, escaped(columns[i].group));
    i += size;
  }
  return html + "</tr>\n";
}

std::string column_headings(const std::vector<HtmlColumn>& columns, bool has_groups) {
  std::string html = "<tr>";
  for (const HtmlColumn& column : columns) {
    if (has_groups && column.group.empty()) continue;
    html += fmt::format("<th scope=\"col\"{}>{}</th>", column.is_published ? " class=\"published\"" : "",
                        escaped(column.heading));
  }
  return html + "</tr>\n";
}

std::string head(const std::vector<HtmlColumn>& columns) {
  bool has_groups = false;
  for (const HtmlColumn& column : columns) has_groups = has_groups || !column.group.empty();
  return (has_groups ? group_headings(columns) : "") + column_headings(columns, has_groups);
}

std::string row(const std::vector<HtmlColumn>& columns, const std::vector<std::string>& cells) {
  std::string html = fmt::format("<tr><th scope=\"row\">{}</th>", escaped(cells.front()));
  for (std::size_t i = 1; i < cells.size(); ++i) {
    html += fmt::format("<td{}>{}</td>", columns[i].is_published ? " class=\"published\"" : "",
                        escaped(cells[i]));
  }
  return html + "</tr>\n";
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&#39;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string base64(std::string_view bytes) {
  std::vector<unsigned char> text(4 * ((bytes.size() + 2) / 3) + 1);  // and a terminating zero
  const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
  const int length = EVP_EncodeBlock(text.data(), data, static_cast<int>(bytes.size()));
  return {text.begin(), text.begin() + length};
}

std::string html(const HtmlTable& table) {
  constexpr std::size_t many_columns = 14;  // more columns need smaller print to fit on paper
  std::string text = fmt::format(
      "<figure class=\"table{}\"><figcaption>{}</figcaption>\n"
      "<div class=\"scroll\" tabindex=\"0\"><table>\n<thead>\n{}</thead>\n<tbody>\n",
      table.columns.size() > many_columns ? " wide" : "", table.caption_html, head(table.columns));
  for (const std::vector<std::string>& cells : table.rows) text += row(table.columns, cells);
  return text + "</tbody>\n</table></div></figure>\n";
}

std::string paragraph(std::string_view css_class, std::string_view text_html) {
  return fmt::format("<p class=\"{}\">{}</p>\n", css_class, text_html);
}

}  // namespace tanglebin
