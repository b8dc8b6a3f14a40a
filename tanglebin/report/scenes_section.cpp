// Scenes in 3D.
#include <fmt/format.h>

#include "tanglebin/report/html.hpp"
#include "tanglebin/report/scene_view.hpp"
#include "tanglebin/report/sections.hpp"
#include "tanglebin/report/text.hpp"
#include "tanglebin/report/write_scenes.hpp"

namespace tanglebin {

std::string scenes_in_3d(const Results& results) {
  constexpr const char* heading = "Scenes in 3D";
  if (results.scenes.empty()) {
    return section_html(
        "scenes", heading,
        paragraph("missing", "The results have no scenes in 3D (<code>scenes.jsonl</code>)."));
  }
  const std::string note = paragraph(
      "note",
      fmt::format("The scenes with the lowest micro-recall of each method, and those in which the methods "
                  "differ most, each with at most {} of its points. <code>experiment --scenes</code> "
                  "chooses how many of each.",
                  most_points_of_results));
  const std::string instead = paragraph(
      "note", "To turn the scenes, a browser needs JavaScript and WebGL. The pictures below need neither.");
  return section_html("scenes", heading, note + scene_figure(results.scenes, instead));
}

}  // namespace tanglebin
