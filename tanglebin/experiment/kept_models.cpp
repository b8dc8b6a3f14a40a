#include "tanglebin/experiment/kept_models.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "tanglebin/base/bytes_of.hpp"
#include "tanglebin/cloud/label_colors.hpp"
#include "tanglebin/files/safe_file.hpp"
#include "tanglebin/io/configuration.hpp"
#include "tanglebin/io/ply.hpp"
#include "tanglebin/model/tubes_json.hpp"

namespace tanglebin {

namespace fs = std::filesystem;

namespace {
constexpr const char* models_folder = "models";
}  // namespace

std::vector<fs::path> files_of(const RunId& run) {
  const fs::path folder = fs::path(models_folder) / run.method / fmt::format("{}", run.ratio);
  return {folder / file_of(run.scene, "plys", "ply", run.scanner),
          folder / file_of(run.scene, "tube_configurations", "txt", run.scanner),
          folder / file_of(run.scene, "tubes", "json", run.scanner)};
}

void keep_model(const fs::path& directory, const RunId& run, const PointCloud& cloud, const Model& model) {
  const std::vector<std::string> contents = {
      bytes_of([&](std::ostream& out) { write_ply(out, labelled(cloud, model.labels)); }),
      bytes_of([&](std::ostream& out) { write_configuration(out, model.tubes); }), tubes_json(model) + '\n'};
  const std::vector<fs::path> files = files_of(run);
  for (std::size_t i = 0; i < files.size(); ++i) {
    make_directories((directory / files[i]).parent_path());
    write_file(directory / files[i], contents[i]);
  }
}

Entry entry_of_kept(const fs::path& directory, const std::string& method) {
  return {method, LabelsDirectory{(directory / models_folder / method / "{ratio}").string()}};
}

bool has_model(const fs::path& directory, const RunId& run) {
  return std::ranges::all_of(files_of(run),
                             [&](const fs::path& file) { return fs::exists(directory / file); });
}

}  // namespace tanglebin
