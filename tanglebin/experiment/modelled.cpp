#include "tanglebin/experiment/modelled.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <sstream>
#include <type_traits>
#include <utility>

#include "tanglebin/base/error.hpp"
#include "tanglebin/dataset/sha256.hpp"
#include "tanglebin/experiment/given_cloud.hpp"
#include "tanglebin/experiment/run_command.hpp"
#include "tanglebin/files/read_file.hpp"
#include "tanglebin/io/configuration.hpp"
#include "tanglebin/model/scene/label.hpp"

namespace tanglebin {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::size_t largest_labels_file = std::size_t{1} << 31U;  // bytes

Modelled model_by_method(const KnownScene& known, const CaseData& data, const RunId& run,
                         const ExperimentSettings& settings) {
  const Clock::time_point start = Clock::now();
  Modelled modelled{.model = model_case(known, data, run, settings)};
  modelled.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return modelled;
}

Modelled model_by(const BuiltIn& own, const KnownScene& known, const CaseData& data, RunId run,
                  ExperimentSettings settings) {
  settings.model = own.model;
  run.method = name_of(own.method);
  return model_by_method(known, data, run, settings);
}

// Of labels for the points of the case's cloud (empty: those of the nearest tubes), or tubes, or both.
Modelled modelled_from(const CaseData& data, const SeenPoints& seen, std::vector<std::int32_t> labels,
                       std::optional<std::vector<Tube>> tubes) {
  Modelled modelled{.model = {}, .has_tubes = tubes.has_value()};
  Model& model = modelled.model;
  model.filtered = seen.scored;
  model.tubes = std::move(tubes).value_or(std::vector<Tube>());
  model.evidence.resize(model.tubes.size());
  model.labels = std::move(labels);
  if (model.labels.empty()) {
    std::vector<std::int32_t> unclaimed(data.cloud.points.size(), null_label);
    model.labels = label_points(data.cloud, seen.cropped, std::move(unclaimed), model.tubes, {});
  }
  return modelled;
}

Modelled model_by_command(const Command& command, const KnownScene& known, const CaseData& data,
                          const SeenPoints& seen, const fs::path& scratch) {
  CommandOutput output = run_command(command, given_cloud(data.cloud, seen), known, scratch);
  std::vector<std::int32_t> labels;
  if (output.labels) {
    labels.assign(data.cloud.points.size(), null_label);
    for (std::size_t i = 0; i < seen.given.size(); ++i) labels[seen.given[i]] = (*output.labels)[i];
  }
  Modelled modelled = modelled_from(data, seen, std::move(labels), std::move(output.tubes));
  modelled.seconds = output.seconds;
  return modelled;
}

fs::path with_ratio(const LabelsDirectory& directory, double ratio) {
  constexpr std::string_view placeholder = "{ratio}";
  std::string path = directory.path;
  if (const std::size_t at = path.find(placeholder); at != std::string::npos)
    path.replace(at, placeholder.size(), fmt::format("{}", ratio));
  return path;
}

/// A file of labels or tubes.
struct FoundFile {
  fs::path path;
  std::string bytes;
};

std::optional<FoundFile> file_if_there(const fs::path& path) {
  std::optional<std::string> bytes = read_if_there(path, largest_labels_file);
  if (!bytes) return std::nullopt;
  return FoundFile{path, std::move(*bytes)};
}

std::optional<FoundFile> labels_file(const fs::path& directory, const RunId& run) {
  for (const auto& [kind, extension] : {std::pair("plys", "ply"), std::pair("pcds", "pcd"),
                                        std::pair("labels", "npy"), std::pair("labels", "txt")}) {
    if (auto file = file_if_there(directory / file_of(run.scene, kind, extension, run.scanner))) return file;
  }
  return std::nullopt;
}

std::optional<FoundFile> tubes_file(const fs::path& directory, const RunId& run) {
  return file_if_there(directory / file_of(run.scene, "tube_configurations", "txt", run.scanner));
}

std::string sha256_of(const std::optional<FoundFile>& labels, const std::optional<FoundFile>& tubes) {
  if (!labels && !tubes) return {};
  return sha256((labels ? sha256(labels->bytes) : "") + (tubes ? sha256(tubes->bytes) : ""));
}

// The labels and tubes of a case in a LabelsDirectory, at a ratio.
struct FoundLabels {
  std::vector<std::int32_t> labels;  // for each point of the case's cloud; empty if there are tubes only
  std::optional<std::vector<Tube>> tubes;
  std::string sha256;  // of the files
};

FoundLabels find_labels(const LabelsDirectory& directory, const RunId& run, const PointCloud& cloud) {
  const fs::path folder = with_ratio(directory, run.ratio);
  const auto labels = labels_file(folder, run);
  const auto tubes = tubes_file(folder, run);
  if (!labels && !tubes)
    throw InputError(
        {folder.string(), 0, ""}, "no labels",
        fmt::format("{} or another file of labels or tubes", file_of(run.scene, "plys", "ply", run.scanner)));
  FoundLabels found{.labels = {}, .tubes = {}, .sha256 = sha256_of(labels, tubes)};
  if (labels) {
    std::istringstream in(labels->bytes);
    const std::string name = labels->path.string();
    found.labels = labels_of_points(cloud, read_labels(in, name), name);
  }
  if (tubes) {
    std::istringstream in(tubes->bytes);
    found.tubes = read_configuration(in, tubes->path.string());
  }
  return found;
}

Modelled model_by_labels(const LabelsDirectory& directory, const CaseData& data, const RunId& run,
                         const SeenPoints& seen) {
  FoundLabels found = find_labels(directory, run, data.cloud);
  Modelled modelled = modelled_from(data, seen, std::move(found.labels), std::move(found.tubes));
  modelled.labels_sha256 = std::move(found.sha256);
  return modelled;
}

}  // namespace

void expect_there(const LabelsDirectory& directory, const std::vector<double>& ratios) {
  for (const double ratio : ratios) {
    const fs::path path = with_ratio(directory, ratio);
    if (!fs::is_directory(path))
      throw InputError({path.string(), 0, ""}, fs::exists(path) ? "a file" : "nothing",
                       "a directory of labels");
  }
}

std::string labels_sha256(const LabelsDirectory& directory, const RunId& run) {
  const fs::path folder = with_ratio(directory, run.ratio);
  return sha256_of(labels_file(folder, run), tubes_file(folder, run));
}

Modelled model_by(const Entry& entry, const KnownScene& known, const CaseData& data, const RunId& run,
                  const ExperimentSettings& settings, const fs::path& scratch) {
  if (std::holds_alternative<Method>(entry.what)) return model_by_method(known, data, run, settings);
  if (const auto* own = std::get_if<BuiltIn>(&entry.what)) return model_by(*own, known, data, run, settings);
  const SeenPoints seen = seen_points(data.cloud, known, run.ratio, model_seed(settings, run.scene));
  if (const auto* command = std::get_if<Command>(&entry.what))
    return model_by_command(*command, known, data, seen, scratch);
  return model_by_labels(std::get<LabelsDirectory>(entry.what), data, run, seen);
}

}  // namespace tanglebin
