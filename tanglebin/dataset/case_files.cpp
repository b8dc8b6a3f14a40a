#include "tanglebin/dataset/case_files.hpp"

#include <sstream>
#include <string_view>
#include <utility>

#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/cloud/pcd.hpp"
#include "tanglebin/cloud/ply.hpp"
#include "tanglebin/dataset/configuration.hpp"
#include "tanglebin/dataset/images.hpp"
#include "tanglebin/dataset/world_sdf.hpp"

namespace tanglebin {
namespace {

template <typename Write>
std::string bytes_of(const Write& write) {
  std::ostringstream out;
  write(out);
  return std::move(out).str();
}

}  // namespace

std::vector<CaseFile> case_files(const Recipe& recipe, const CaseId& id, const Scene& scene) {
  const OutputSettings& output = recipe.output;
  const CloudOf points = output.bin_points ? CloudOf::tubes_and_bin : CloudOf::tubes;
  std::vector<CaseFile> files;
  const auto add = [&](std::string_view kind, std::string_view extension, std::string bytes) {
    files.push_back({file_of(id, kind, extension), std::move(bytes)});
  };

  add("plys", "ply",
      bytes_of([&](std::ostream& out) { write_ply(out, cloud_from_scan(scene.scan, points, id.tubes)); }));
  add("tube_configurations", "txt",
      bytes_of([&](std::ostream& out) { write_configuration(out, scene.tubes); }));
  if (output.worlds) {
    add("gazebo_worlds", "world", bytes_of([&](std::ostream& out) {
          write_world(out, scene.tubes, recipe.bin, recipe.camera, recipe.settle);
        }));
  }
  if (output.pcds) {
    add("pcds", "pcd", bytes_of([&](std::ostream& out) {
          write_pcd(out, organized_cloud_from_scan(scene.scan, points, id.tubes));
        }));
  }
  if (output.depths) {
    add("depths", "png", depth_png(scene.scan));
    add("depths", "json", camera_json(recipe.camera));
  }
  if (output.labels) add("labels", "png", label_png(scene.scan));
  return files;
}

}  // namespace tanglebin
