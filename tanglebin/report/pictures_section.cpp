// The best, median and worst cases.
#include <fmt/format.h>

#include <cstdint>

#include "tanglebin/dataset/seen_case.hpp"
#include "tanglebin/report/html.hpp"
#include "tanglebin/report/sections.hpp"
#include "tanglebin/report/text.hpp"

namespace tanglebin {
namespace {

/// Reads a big-endian number, such as width and height in a PNG header.
std::uint32_t number_at(const std::string& png, std::size_t position) {
  std::uint32_t value = 0;
  for (std::size_t i = position; i < position + 4; ++i) {
    value = value << 8 | static_cast<std::uint8_t>(i < png.size() ? png[i] : 0);
  }
  return value;
}

/// An <img> with its size, so that the page does not move while the picture is decoded.
std::string image(const std::string& png, const std::string& file, const std::string& text) {
  constexpr std::size_t width_position = 16;  // after the signature, and the chunk's length and name
  constexpr std::size_t height_position = 20;
  if (png.empty()) {
    return paragraph("missing", fmt::format("<code>{}</code> is missing.", escaped(file)));
  }
  return fmt::format("<img src=\"data:image/png;base64,{}\" width=\"{}\" height=\"{}\" alt=\"{}\">\n",
                     base64(png), number_at(png, width_position), number_at(png, height_position),
                     escaped(text));
}

std::string case_text(const RunKey& run) {
  return seen_by(run.scanner,
                 fmt::format("set {}, {}, case {}", run.id.set,
                             counted(static_cast<std::size_t>(run.id.tubes), "tube"), run.id.number));
}

std::string rank_text(const std::string& rank) {
  return static_cast<char>(rank.front() - 'a' + 'A') + rank.substr(1);
}

std::string figure(const CasePictures& pictures) {
  const std::string which = case_text(pictures.run);
  return fmt::format(
      "<figure class=\"pictures\">\n<div "
      "class=\"pair\">\n<div>{}<p>truth</p></div>\n<div>{}<p>labels</p></div>\n"
      "</div>\n<figcaption><b>{}:</b> {}, method {}, ratio {}: micro-recall {}.</figcaption></figure>\n",
      image(pictures.truth_png, pictures.truth_file, "The true labels of " + which + "."),
      image(pictures.labels_png, pictures.labels_file,
            fmt::format("The labels of method {} for {}.", pictures.run.method, which)),
      rank_text(pictures.rank), escaped(which), escaped(pictures.run.method), ratio_text(pictures.run.ratio),
      share_text(pictures.micro_recall));
}

}  // namespace

std::string example_pictures(const Results& results) {
  std::string content;
  for (const CasePictures& pictures : results.pictures) content += figure(pictures);
  if (content.empty()) {
    content = paragraph("missing", "The results have no pictures (<code>pictures.jsonl</code>).");
  } else {
    content =
        paragraph(
            "note",
            "The cases with the highest, median and lowest micro-recall: the truth on the left, the "
            "method's labels on the right. Each tube or label has a colour. Black is a tube's point without "
            "a label; grey is not scored, because it is on no tube in truth.") +
        content;
  }
  return section_html("pictures", "Best, median and worst case", content);
}

}  // namespace tanglebin
