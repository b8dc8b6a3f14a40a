#include <fmt/format.h>

#include <array>
#include <string_view>
#include <utility>

#include "tanglebin/export/format.hpp"
#include "tanglebin/export/mask.hpp"
#include "tanglebin/files/read_file.hpp"
#include "tanglebin/io/images.hpp"
#include "tanglebin/scan/scan_output.hpp"

namespace tanglebin {
namespace {

constexpr int tube_category = 1;

/// An annotation file: what its annotations' segmentations are.
struct AnnotationFile {
  std::string_view path;
  std::string_view description;
};
constexpr std::array<AnnotationFile, 3> annotation_files{
    {{"annotations/instances.json", "what the scanner sees of each tube, as run lengths"},
     {"annotations/instances_polygons.json", "what the scanner sees of each tube, as polygons"},
     {"annotations/amodal.json", "each tube as if nothing else were there, as run lengths"}}};

/// What a case adds to the annotation files, each a list.
struct CaseParts {
  Json images = Json::array();
  std::array<Json, annotation_files.size()> annotations{Json::array(), Json::array(), Json::array()};
};

// A line for each list.
std::string parts_file(const CaseId& id) {
  return fmt::format("cases/{}.jsonl", view_name(id, ""));
}

std::string depth_file(const CaseId& id, const std::string& scanner) {
  return fmt::format("depth/{}.png", view_name(id, scanner));
}

Json run_length_segmentation(const Mask& mask) {
  return {{"size", {mask.height, mask.width}}, {"counts", compressed(run_lengths(mask))}};
}

// Without segmentation.
Json annotation(std::size_t id, std::size_t image, const TubeVisibility& tube, const Mask& mask) {
  return {{"id", id},
          {"image_id", image},
          {"category_id", tube_category},
          {"iscrowd", 0},
          {"area", mask.pixels.size()},
          {"bbox", box_of(mask)},
          {"tube", tube.tube},
          {"visible_share", tube.share()},
          {"hidden_share", tube.whole == 0 ? 0 : 1 - tube.share()}};
}

void add_annotation(Json& annotations, Json annotation, Json segmentation) {
  annotation["segmentation"] = std::move(segmentation);
  annotations.push_back(std::move(annotation));
}

// Images and annotations are numbered through the whole recipe, so a case's numbers do not depend on which
// others are exported.
std::size_t image_number(const ExportScene& scene, std::size_t view) {
  return (scene.place.number - 1) * scene.views.size() + view + 1;
}

std::size_t annotation_number(const ExportScene& scene, std::size_t view, std::size_t tube) {
  return scene.place.tubes_before * scene.views.size() + view * scene.tubes.size() + tube + 1;
}

Json image(const ExportScene& scene, const SceneView& view, std::size_t number) {
  const std::string depth = depth_file(scene.id, view.scanner);
  Json json{{"id", number},
            {"file_name", depth},
            {"width", view.scan.camera.width},
            {"height", view.scan.camera.height}};
  json.update(view_json(scene, view));
  return json;
}

CaseParts parts_of(const ExportScene& scene) {
  CaseParts parts;
  for (std::size_t i = 0; i < scene.views.size(); ++i) {
    const SceneView& view = scene.views[i];
    const std::size_t number = image_number(scene, i);
    parts.images.push_back(image(scene, view, number));
    const std::vector<Mask> masks = measured_masks(view.scan, scene.tubes.size());
    for (std::size_t tube = 0; tube < scene.tubes.size(); ++tube) {
      const TubeVisibility& visibility = view.occlusions.tubes[tube];
      const std::size_t id = annotation_number(scene, i, tube);
      if (const Mask& mask = masks[tube]; !mask.pixels.empty()) {
        const Json seen = annotation(id, number, visibility, mask);
        add_annotation(parts.annotations[0], seen, run_length_segmentation(mask));
        add_annotation(parts.annotations[1], seen, polygons(mask));
      }
      if (const Mask whole = whole_mask(view.whole[tube], view.scan.camera); !whole.pixels.empty()) {
        add_annotation(parts.annotations[2], annotation(id, number, visibility, whole),
                       run_length_segmentation(whole));
      }
    }
  }
  return parts;
}

void write_case(const ExportUnit& unit, const SceneReader& reader, ExportFiles& files) {
  const ExportScene scene = reader.read(unit.cases.front());
  for (const SceneView& view : scene.views)
    files.write(depth_file(scene.id, view.scanner), depth_png(depth_image(view.scan)));
  const CaseParts parts = parts_of(scene);
  std::string lines = json_text(parts.images) + '\n';
  for (const Json& annotations : parts.annotations) lines += json_text(annotations) + '\n';
  files.seal(parts_file(scene.id), lines);
}

// Writes a list of what all cases have in one line of their parts.
void write_list(const std::vector<ExportUnit>& units, std::size_t line, const ExportFiles& files,
                const Sink& sink) {
  std::string_view separator = "[\n";
  for (const ExportUnit& unit : units) {
    for_each_line(files.directory() / parts_file(unit.cases.front()), [&](const FileLine& found) {
      const std::string_view items = std::string_view(found.text).substr(1, found.text.size() - 2);
      if (found.number != line || items.empty()) return;
      sink(separator);
      sink(items);
      separator = ",\n";
    });
  }
  sink(separator == "[\n" ? "[]" : "\n]");
}

void write_annotation_file(const std::vector<ExportUnit>& units, std::size_t index, ExportFiles& files) {
  const auto& [path, description] = annotation_files.at(index);
  const Json info{{"description", description}};
  const Json categories = Json::array({{{"id", tube_category}, {"name", "tube"}, {"supercategory", "tube"}}});
  files.seal(std::string(path), [&](const Sink& sink) {
    sink(fmt::format("{{\"info\":{},\"licenses\":[],\"categories\":{},\n\"images\":", json_text(info),
                     json_text(categories)));
    write_list(units, 1, files, sink);
    sink(",\n\"annotations\":");
    write_list(units, index + 2, files, sink);
    sink("}\n");
  });
}

std::vector<std::string> common_files() {
  std::vector<std::string> files;
  files.reserve(annotation_files.size());
  for (const AnnotationFile& file : annotation_files) files.emplace_back(file.path);
  return files;
}

void assemble(const std::vector<ExportUnit>& units, ExportFiles& files) {
  for (std::size_t index = 0; index < annotation_files.size(); ++index)
    write_annotation_file(units, index, files);
}

}  // namespace

Format coco_format(const Recipe& recipe) {
  return {.files_of =
              [all = scanners(recipe)](const ExportUnit& unit) {
                const CaseId& id = unit.cases.front();
                std::vector<std::string> files{parts_file(id)};
                for (const Scanner& scanner : all) files.push_back(depth_file(id, scanner.name));
                return files;
              },
          .write = write_case,
          .common_files = common_files(),
          .assemble = assemble};
}

}  // namespace tanglebin
