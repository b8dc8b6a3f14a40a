#include "tanglebin/report/text.hpp"

#include <fmt/format.h>

#include "tanglebin/report/html.hpp"

namespace tanglebin {

std::string seconds_text(std::optional<double> seconds, int decimals) {
  return seconds ? fmt::format("{:.{}f}", *seconds, decimals) : "–";
}

std::string share_text(std::optional<double> share) {
  return share ? fmt::format("{:.3f}", *share) : "–";
}

std::string mean_text(const Summary& summary) {
  return share_text(summary.mean) + (summary.interval ? fmt::format(" ± {:.3f}", *summary.interval) : "");
}

std::string ratio_text(double ratio) {
  return fmt::format("{:.6g}", ratio);
}

std::string counted(std::size_t count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

std::string group_text(const RunGroup& group, const Results& results) {
  if (results.experiment.methods.size() < 2) return "Set " + group.set;
  return fmt::format("Set {}, {}", group.set, group.method);
}

std::string section_html(std::string_view id, std::string_view heading, const std::string& content_html) {
  return fmt::format(
      "<section id=\"{0}\" aria-labelledby=\"{0}-heading\">\n<h2 "
      "id=\"{0}-heading\">{1}</h2>\n{2}</section>\n",
      id, escaped(heading), content_html);
}

}  // namespace tanglebin
