#include <fmt/format.h>

#include "tanglebin/base/bytes_of.hpp"
#include "tanglebin/export/archive.hpp"
#include "tanglebin/export/format.hpp"
#include "tanglebin/export/mask.hpp"
#include "tanglebin/io/configuration.hpp"
#include "tanglebin/io/images.hpp"
#include "tanglebin/io/ply.hpp"
#include "tanglebin/scan/scan_output.hpp"

namespace tanglebin {
namespace {

// The samples of a tar file, as tools read one whole tar file after the other.
constexpr std::size_t cases_per_tar = 50;

std::string tar_of(const ExportUnit& unit) {
  return fmt::format("{:06}.tar", unit.number - 1);
}

Json sample_json(const ExportScene& scene, const SceneView& view) {
  Json json = view_json(scene, view);
  json["whole_masks"] = Json::array();
  for (const WholeView& tube : view.whole) {
    const Mask mask = whole_mask(tube, view.scan.camera);
    json["whole_masks"].push_back(
        {{"id", tube.tube}, {"size", {mask.height, mask.width}}, {"counts", compressed(run_lengths(mask))}});
  }
  return json;
}

void add_sample(ArchiveWriter& tar, const ExportScene& scene, const SceneView& view) {
  const std::string key = view_name(scene.id, view.scanner);
  const CloudOf what = scene.recipe.output.bin_points ? CloudOf::tubes_and_bin : CloudOf::tubes;
  tar.add(key + ".depth.png", depth_png(depth_image(view.scan)));
  tar.add(key + ".json", json_text(sample_json(scene, view)));
  tar.add(key + ".labels.png", label_png(label_image(view.scan)));
  tar.add(key + ".ply", bytes_of([&](std::ostream& out) {
            write_ply(out, cloud_from_scan(view.scan, what, scene.id.tubes, scene.recipe.output.properties));
          }));
  tar.add(key + ".tubes.txt", bytes_of([&](std::ostream& out) { write_configuration(out, scene.tubes); }));
}

void write_tar(const ExportUnit& unit, const SceneReader& reader, ExportFiles& files) {
  files.seal(tar_of(unit), [&](const Sink& sink) {
    ArchiveWriter tar(ArchiveWriter::Format::tar, sink);
    for (const CaseId& id : unit.cases) {
      const ExportScene scene = reader.read(id);
      for (const SceneView& view : scene.views) add_sample(tar, scene, view);
    }
    tar.close();
  });
}

}  // namespace

Format webdataset_format() {
  return {.cases_per_unit = cases_per_tar,
          .files_of = [](const ExportUnit& unit) { return std::vector{tar_of(unit)}; },
          .write = write_tar};
}

}  // namespace tanglebin
