#include "tanglebin/export/format.hpp"

#include <fmt/format.h>

namespace tanglebin {
namespace {

std::string path_of_view(const CaseId& id, const std::string& scanner, const std::string& extension) {
  return fmt::format("{}/{}{}{}.{}", folder_name(id.set, id.tubes), scanner, scanner.empty() ? "" : "/",
                     id.number, extension);
}

}  // namespace

Format file_per_view(const Recipe& recipe, const std::string& extension,
                     const std::function<std::string(const ExportScene&, const SceneView&)>& bytes_of) {
  return {.files_of =
              [=, all = scanners(recipe)](const ExportUnit& unit) {
                std::vector<std::string> files;
                files.reserve(all.size());
                for (const Scanner& scanner : all)
                  files.push_back(path_of_view(unit.cases.front(), scanner.name, extension));
                return files;
              },
          .write =
              [=](const ExportUnit& unit, const SceneReader& reader, ExportFiles& files) {
                const ExportScene scene = reader.read(unit.cases.front());
                for (const SceneView& view : scene.views)
                  files.seal(path_of_view(scene.id, view.scanner, extension), bytes_of(scene, view));
              }};
}

PackedMasks packed_whole_masks(const SceneView& view) {
  PackedMasks masks{{0}, {}};
  for (const WholeView& tube : view.whole) {
    masks.pixels.insert(masks.pixels.end(), tube.pixels.begin(), tube.pixels.end());
    masks.starts.push_back(static_cast<std::uint32_t>(masks.pixels.size()));
  }
  return masks;
}

}  // namespace tanglebin
