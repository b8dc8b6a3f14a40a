#include "tanglebin/export/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "tanglebin/base/error.hpp"
#include "tanglebin/dataset/scene_facts.hpp"
#include "tanglebin/geometry/labels.hpp"
#include "tanglebin/io/configuration.hpp"
#include "tanglebin/io/images.hpp"
#include "tanglebin/recipe/case_json.hpp"
#include "tanglebin/scan/scanner.hpp"

namespace tanglebin {
namespace {

std::vector<Tube> tubes_of(const Dataset& dataset, const CaseRecord& record) {
  const std::string path = file_of(record.id, "tube_configurations", "txt");
  const std::string name = (dataset.directory / path).string();
  const auto listed = std::ranges::find(record.files, path, &FileRecord::path);
  if (listed == record.files.end()) throw InputError({name, 0, ""}, "not in the manifest");
  std::istringstream in(checked_bytes(dataset.directory, *listed));
  std::vector<Tube> tubes = read_configuration(in, name);
  std::ranges::sort(tubes, {}, &Tube::id);
  return tubes;
}

std::size_t points_in_manifest(const CaseRecord& record, const std::string& scanner) {
  const auto found = std::ranges::find(record.scanners, scanner, &ScannerRecord::name);
  return found == record.scanners.end() ? record.points : found->points;
}

void expect_the_same_scan(const Dataset& dataset, const CaseRecord& record, const SceneView& view) {
  const std::int32_t least = dataset.recipe.output.bin_points ? bin_label : bin_label + 1;
  const auto points = static_cast<std::size_t>(
      std::ranges::count_if(view.scan.pixels, [&](const Pixel& pixel) { return pixel.label >= least; }));
  const std::size_t expected = points_in_manifest(record, view.scanner);
  if (points == expected) return;
  throw InputError(
      {dataset.directory.string(), 0, name_of(record.id)}, fmt::format("a scan of {} points", points),
      fmt::format("{}, as the manifest says: another version of Tanglebin made the dataset", expected));
}

}  // namespace

std::map<CaseId, CasePlace> case_places(const Recipe& recipe) {
  std::map<CaseId, CasePlace> places;
  CasePlace next{1, 0};
  for (const CaseId& id : cases(recipe)) {
    places.emplace(id, next);
    ++next.number;
    next.tubes_before += static_cast<std::size_t>(id.tubes);
  }
  return places;
}

SceneReader::SceneReader(const Dataset& dataset) : dataset_(dataset), places_(case_places(dataset.recipe)) {}

ExportScene SceneReader::read(const CaseId& id) const {
  const CaseRecord record = dataset_.catalogue.record(id);
  ExportScene scene{.id = id,
                    .place = places_.at(id),
                    .seed = record.seed,
                    .recipe = resolve(dataset_.recipe, id, record.drawn),
                    .tubes = tubes_of(dataset_, record),
                    .contacts = {},
                    .views = {}};
  scene.contacts = contacts(scene.tubes, scene.recipe.bin);
  for (const Scanner& scanner : scanners(scene.recipe)) {
    const auto& [name, camera, sensor] = scanner;
    SceneView view{.scanner = name,
                   .scan = scan(scene.tubes, scene.recipe.bin, camera, sensor, record.seed, name),
                   .whole = whole_views(scene.tubes, camera),
                   .occlusions = {}};
    expect_the_same_scan(dataset_, record, view);
    view.occlusions = occlusions(scene.tubes, view.whole, scene.recipe.bin, camera);
    scene.views.push_back(std::move(view));
  }
  return scene;
}

std::string view_name(const CaseId& id, const std::string& scanner) {
  return fmt::format("{}-{:06}{}{}", folder_name(id.set, id.tubes), id.number, scanner.empty() ? "" : "-",
                     scanner);
}

Json view_json(const ExportScene& scene, const SceneView& view) {
  Json json = id_json(scene.id);
  if (!view.scanner.empty()) json["scanner"] = view.scanner;
  json["seed"] = seed_text(scene.seed);
  json["camera"] = Json::parse(camera_json(view.scan.camera));
  // The same as occlusions/N.json of a dataset.
  json["occlusions"] = facts_json(view.occlusions, scene.contacts);
  return json;
}

}  // namespace tanglebin
