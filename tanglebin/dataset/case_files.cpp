#include "tanglebin/dataset/case_files.hpp"

#include <string_view>
#include <utility>

#include "tanglebin/base/bytes_of.hpp"
#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/dataset/scene_facts.hpp"
#include "tanglebin/io/configuration.hpp"
#include "tanglebin/io/images.hpp"
#include "tanglebin/io/pcd.hpp"
#include "tanglebin/io/ply.hpp"
#include "tanglebin/scan/scan_output.hpp"
#include "tanglebin/simulate/world_sdf.hpp"

namespace tanglebin {
namespace {

CloudOf points_of(const Recipe& recipe) {
  return recipe.output.bin_points ? CloudOf::tubes_and_bin : CloudOf::tubes;
}

void add_cloud(const Recipe& recipe, const CaseId& id, const std::string& scanner, const Scan& view,
               std::vector<CaseFile>& files) {
  if (!recipe.output.plys) return;
  files.push_back({file_of(id, "plys", "ply", scanner), bytes_of([&](std::ostream& out) {
                     write_ply(out,
                               cloud_from_scan(view, points_of(recipe), id.tubes, recipe.output.properties));
                   })});
}

/// The files that are organized as the image is.
void add_images(const Recipe& recipe, const CaseId& id, const std::string& scanner, const Scan& view,
                std::vector<CaseFile>& files) {
  const OutputSettings& output = recipe.output;
  const auto add = [&](std::string_view kind, std::string_view extension, std::string bytes) {
    files.push_back({file_of(id, kind, extension, scanner), std::move(bytes)});
  };
  if (output.pcds) {
    add("pcds", "pcd", bytes_of([&](std::ostream& out) {
          write_pcd(out, organized_cloud_from_scan(view, points_of(recipe), id.tubes, output.properties));
        }));
  }
  if (output.depths) {
    add("depths", "png", depth_png(depth_image(view)));
    add("depths", "json", camera_json(view.camera));
  }
  if (output.labels) add("labels", "png", label_png(label_image(view)));
}

void add_occlusions(const Recipe& recipe, const CaseId& id, const Scanner& scanner,
                    const std::vector<Tube>& tubes, std::vector<CaseFile>& files) {
  if (!recipe.output.occlusions) return;
  const Occlusions seen = occlusions(tubes, whole_views(tubes, scanner.camera), recipe.bin, scanner.camera);
  files.push_back({file_of(id, "occlusions", "json", scanner.name),
                   json_text(facts_json(seen, contacts(tubes, recipe.bin))) + '\n'});
}

}  // namespace

std::vector<std::string> paths_of(const Recipe& recipe, const CaseId& id) {
  const OutputSettings& output = recipe.output;
  std::vector<std::string> paths;
  for (const Scanner& scanner : scanners(recipe)) {
    const auto add = [&](std::string_view kind, std::string_view extension) {
      paths.push_back(file_of(id, kind, extension, scanner.name));
    };
    const bool is_first = paths.empty();
    if (output.plys) add("plys", "ply");
    if (is_first) {
      paths.push_back(file_of(id, "tube_configurations", "txt"));
      if (output.worlds) paths.push_back(file_of(id, "gazebo_worlds", "world"));
    }
    if (output.pcds) add("pcds", "pcd");
    if (output.depths) {
      add("depths", "png");
      add("depths", "json");
    }
    if (output.labels) add("labels", "png");
    if (output.occlusions) add("occlusions", "json");
  }
  return paths;
}

std::vector<CaseFile> case_files(const Recipe& recipe, const CaseId& id, const SimulatedScene& scene) {
  std::vector<CaseFile> files;
  const auto add = [&](std::string_view kind, std::string_view extension, std::string bytes) {
    files.push_back({file_of(id, kind, extension), std::move(bytes)});
  };

  add_cloud(recipe, id, recipe.scanner_name, scene.scan, files);
  add("tube_configurations", "txt",
      bytes_of([&](std::ostream& out) { write_configuration(out, scene.tubes); }));
  if (recipe.output.worlds) {
    add("gazebo_worlds", "world", bytes_of([&](std::ostream& out) {
          write_world(out, scene.tubes, recipe.bin, recipe.camera, recipe.settle);
        }));
  }
  add_images(recipe, id, recipe.scanner_name, scene.scan, files);
  add_occlusions(recipe, id, scanners(recipe).front(), scene.tubes, files);
  for (std::size_t i = 0; i < recipe.further_scanners.size(); ++i) {
    const std::string& name = recipe.further_scanners[i].name;
    add_cloud(recipe, id, name, scene.further_scans[i], files);
    add_images(recipe, id, name, scene.further_scans[i], files);
    add_occlusions(recipe, id, recipe.further_scanners[i], scene.tubes, files);
  }
  return files;
}

}  // namespace tanglebin
