#include "tanglebin/dataset/dataset.hpp"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "images.hpp"
#include "long_work.hpp"
#include "tanglebin/dataset/generate_dataset.hpp"
#include "tanglebin/dataset/merge_datasets.hpp"
#include "tanglebin/dataset/repair_dataset.hpp"
#include "tanglebin/dataset/seen_case.hpp"
#include "tanglebin/dataset/verify_dataset.hpp"
#include "tanglebin/experiment/run.hpp"
#include "tanglebin/experiment/score_dataset.hpp"
#include "tanglebin/io/configuration.hpp"
#include "tanglebin/io/depth_input.hpp"
#include "tanglebin/io/images.hpp"
#include "tanglebin/io/ply.hpp"

namespace tanglebin::python {
namespace {

namespace fs = std::filesystem;

/// The finished cases of a dataset that is open.
struct Index {
  explicit Index(const fs::path& directory) : dataset(read_dataset(directory)), ids(cases(dataset)) {}

  Dataset dataset;
  std::vector<CaseId> ids;
};

/// A file of a case, checked against the manifest.
struct CheckedFile {
  std::string name;  ///< for messages
  std::string bytes;
};

CheckedFile file_of(const Index& index, const CaseId& id, const char* kind, const char* extension,
                    const std::string& scanner = "") {
  const CaseRecord record = index.dataset.catalogue.record(id);
  const std::string path = file_of(id, kind, extension, scanner);
  const auto listed = std::ranges::find(record.files, path, &FileRecord::path);
  const std::string name = (index.dataset.directory / path).string();
  if (listed == record.files.end()) throw InputError({name, 0, ""}, "not in the manifest");
  return {name, checked_bytes(index.dataset.directory, *listed)};
}

PointCloud cloud_of(const Index& index, const CaseId& id, const std::string& scanner) {
  const auto [name, bytes] = file_of(index, id, "plys", "ply", scanner);
  std::istringstream in(bytes);
  return read_ply(in, name);
}

std::vector<Tube> tubes_of(const Index& index, const CaseId& id) {
  const auto [name, bytes] = file_of(index, id, "tube_configurations", "txt");
  std::istringstream in(bytes);
  return read_configuration(in, name);
}

DepthImage depths_of(const Index& index, const CaseId& id, const std::string& scanner) {
  const auto [name, bytes] = file_of(index, id, "depths", "png", scanner);
  std::istringstream in(bytes);
  return read_depths(in, name, depth_scale);
}

LabelImage labels_of(const Index& index, const CaseId& id, const std::string& scanner) {
  const auto [name, bytes] = file_of(index, id, "labels", "png", scanner);
  return labels_of_png(bytes, name);
}

std::vector<CaseId> wanted_of(const Recipe& recipe, const std::optional<std::vector<CaseId>>& wanted) {
  return wanted ? *wanted : cases(recipe);
}

// Runs over a dataset: in worker processes, and with signals kept until the end.
template <typename Run>
auto run_over_dataset(const Progress& progress, const Run& run) {
  const RunObserver observer = observer_of(progress);
  return without_gil([&] {
    const SimulationTurn turn;
    return run(observer);
  });
}

FillSummary ended(FillSummary summary, const Progress& progress) {
  if (summary.was_interrupted) pass_on_signal();
  if (progress) {
    const RunProgress& run = summary.progress;
    (*progress)(run.found + run.made + run.failed, run.wanted);
  }
  return summary;
}

void bind_runs(py::module_& module) {
  py::class_<FailedCase>(module, "FailedCase", doc::dataset::FailedCase)
      .def_readonly("id", &FailedCase::id, "the case")
      .def_readonly("seed", &FailedCase::seed, doc::dataset::FailedCase_seed)
      .def_readonly("reason", &FailedCase::reason, "why");
  py::class_<RunProgress>(module, "RunProgress", doc::dataset::RunProgress)
      .def_readonly("wanted", &RunProgress::wanted, doc::dataset::RunProgress_wanted)
      .def_readonly("found", &RunProgress::found, doc::dataset::RunProgress_found)
      .def_readonly("made", &RunProgress::made, doc::dataset::RunProgress_made)
      .def_readonly("failed", &RunProgress::failed, doc::dataset::RunProgress_failed)
      .def_readonly("rejected", &RunProgress::rejected, doc::dataset::RunProgress_rejected);
  py::class_<DatasetSummary>(module, "DatasetSummary", doc::dataset::DatasetSummary)
      .def_readonly("cases", &DatasetSummary::cases, doc::dataset::DatasetSummary_cases)
      .def_readonly("recipe_cases", &DatasetSummary::recipe_cases, doc::dataset::DatasetSummary_recipe_cases)
      .def_readonly("failed", &DatasetSummary::failed, doc::dataset::DatasetSummary_failed)
      .def_readonly("files", &DatasetSummary::files, doc::dataset::DatasetSummary_files)
      .def_readonly("digest", &DatasetSummary::digest, doc::dataset::DatasetSummary_digest)
      .def_property_readonly("is_complete", &DatasetSummary::is_complete,
                             "whether it has all of the recipe's cases");
  py::class_<FillSummary>(module, "FillSummary", doc::dataset::FillSummary)
      .def_readonly("progress", &FillSummary::progress, doc::dataset::RunProgress)
      .def_readonly("failed", &FillSummary::failed, doc::dataset::FillSummary_failed)
      .def_readonly("dataset", &FillSummary::dataset, doc::dataset::FillSummary_dataset)
      .def_property_readonly("is_complete", &FillSummary::is_complete,
                             "whether all cases asked for are there");
  const char* const note =
      "`progress` is called with the cases done so far and all that are wanted. Ctrl-C finishes the cases in "
      "progress, "
      "keeps what is done and raises KeyboardInterrupt; call it again to go on. The worker processes run no "
      "Python.";
  module.def(
      "generate_dataset",
      [](const Recipe& recipe, const fs::path& directory, const std::optional<std::vector<CaseId>>& wanted,
         int jobs, const Progress& progress) {
        validate(recipe);
        if (recipe.random.empty()) expect_bin_in_view(recipe);
        return ended(run_over_dataset(progress,
                                      [&](const RunObserver& observer) {
                                        return generate_dataset(recipe, wanted_of(recipe, wanted), directory,
                                                                jobs, observer);
                                      }),
                     progress);
      },
      py::arg("recipe"), py::arg("directory"), py::arg("wanted") = py::none(), py::arg("jobs") = 1,
      py::arg("progress") = py::none(), also(doc::dataset::generate_dataset, note).c_str());
  module.def(
      "merge_datasets",
      [](const std::vector<fs::path>& parts, const fs::path& directory, int jobs, const Progress& progress) {
        return ended(run_over_dataset(progress,
                                      [&](const RunObserver& observer) {
                                        return merge_datasets(parts, directory, jobs, observer);
                                      }),
                     progress);
      },
      py::arg("parts"), py::arg("directory"), py::arg("jobs") = 1, py::arg("progress") = py::none(),
      also(doc::dataset::merge_datasets, note).c_str());
}

void bind_verify(py::module_& module) {
  py::class_<DatasetFault>(module, "DatasetFault", doc::dataset::DatasetFault)
      .def_readonly("where", &DatasetFault::where, doc::dataset::DatasetFault_where)
      .def_readonly("what", &DatasetFault::what, "what is wrong");
  py::class_<VerifySummary>(module, "VerifySummary", doc::dataset::VerifySummary)
      .def_readonly("cases", &VerifySummary::cases, doc::dataset::VerifySummary_cases)
      .def_readonly("digest", &VerifySummary::digest, doc::dataset::VerifySummary_digest)
      .def_readonly("faults", &VerifySummary::faults, doc::dataset::VerifySummary_faults)
      .def_readonly("notes", &VerifySummary::notes, doc::dataset::VerifySummary_notes)
      .def_readonly("broken", &VerifySummary::broken, doc::dataset::VerifySummary_broken);
  module.def(
      "verify_dataset",
      [](const fs::path& directory, int jobs, bool rest, const std::optional<std::vector<CaseId>>& wanted,
         const Progress& progress) {
        VerifySummary summary = run_over_dataset(progress, [&](const RunObserver& observer) {
          return verify_dataset(directory, {jobs, rest, wanted}, observer);
        });
        if (summary.was_stopped) pass_on_signal();
        return summary;
      },
      py::arg("directory"), py::arg("jobs") = 1, py::arg("rest") = false, py::arg("wanted") = py::none(),
      py::arg("progress") = py::none(), doc::dataset::verify_dataset);
  module.def(
      "repair_dataset",
      [](const fs::path& directory, const VerifySummary& found, int jobs, const Progress& progress) {
        return ended(run_over_dataset(progress,
                                      [&](const RunObserver& observer) {
                                        return repair_dataset(directory, found, jobs, observer);
                                      }),
                     progress);
      },
      py::arg("directory"), py::arg("found"), py::arg("jobs") = 1, py::arg("progress") = py::none(),
      doc::dataset::repair_dataset);
}

void bind_records(py::module_& module) {
  py::class_<FileRecord>(module, "FileRecord", doc::dataset::FileRecord)
      .def_readonly("path", &FileRecord::path, doc::dataset::FileRecord_path)
      .def_readonly("bytes", &FileRecord::bytes, "its size")
      .def_readonly("sha256", &FileRecord::sha256, "its checksum");
  py::class_<CaseRecord>(module, "CaseRecord", doc::dataset::CaseRecord)
      .def_readonly("id", &CaseRecord::id, "the case")
      .def_readonly("seed", &CaseRecord::seed, "of the successful attempt")
      .def_readonly("simulated", &CaseRecord::simulated, doc::dataset::CaseRecord_simulated)
      .def_readonly("largest_overlap", &CaseRecord::largest_overlap, doc::dataset::CaseRecord_largest_overlap)
      .def_readonly("points", &CaseRecord::points, doc::dataset::CaseRecord_points)
      .def_readonly("rejections", &CaseRecord::rejections, "the attempts before")
      .def_readonly("files", &CaseRecord::files, "its files")
      .def_property_readonly(
          "json", [](const CaseRecord& record) { return to_json(record); }, doc::dataset::to_json);
}

}  // namespace

void bind_dataset(py::module_& module) {
  bind_runs(module);
  bind_verify(module);
  bind_records(module);
}

void bind_index(py::module_& module) {
  py::class_<Index, std::shared_ptr<Index>>(
      module, "Index", "What a dataset's directory lists; tanglebin.Dataset is the way to it.")
      .def(py::init([](const fs::path& directory) {
             return without_gil([&] { return std::make_shared<Index>(directory); });
           }),
           py::arg("directory"))
      .def(py::pickle(
          [](const Index& index) { return py::make_tuple(index.dataset.directory); },
          [](const py::tuple& state) { return std::make_shared<Index>(state[0].cast<fs::path>()); }))
      .def_property_readonly(
          "directory", [](const Index& index) { return index.dataset.directory; }, "the dataset's directory")
      .def_property_readonly(
          "recipe", [](const Index& index) { return index.dataset.recipe; }, "the dataset's recipe")
      .def_readonly("ids", &Index::ids, "the finished cases, in the recipe's order")
      .def(
          "record", [](const Index& index, const CaseId& id) { return index.dataset.catalogue.record(id); },
          py::arg("id"), doc::dataset::Catalogue_record)
      .def(
          "recipe_of", [](const Index& index, const CaseId& id) { return recipe_of(index.dataset, id); },
          py::arg("id"), doc::dataset::recipe_of)
      .def(
          "known",
          [](const Index& index, const CaseId& id, const std::string& scanner) {
            return known_scene(recipe_seen(index.dataset, {id, scanner}), id);
          },
          py::arg("id"), py::arg("scanner") = "")
      .def(
          "cloud",
          [](const Index& index, const CaseId& id, const std::string& scanner) {
            return without_gil([&] { return cloud_of(index, id, scanner); });
          },
          py::arg("id"), py::arg("scanner") = "")
      .def(
          "tubes",
          [](const Index& index, const CaseId& id) {
            return without_gil([&] { return tubes_of(index, id); });
          },
          py::arg("id"))
      .def(
          "depths",
          [](const Index& index, const CaseId& id, const std::string& scanner) {
            return array_of(without_gil([&] { return depths_of(index, id, scanner); }));
          },
          py::arg("id"), py::arg("scanner") = "")
      .def(
          "labels",
          [](const Index& index, const CaseId& id, const std::string& scanner) {
            return array_of(without_gil([&] { return labels_of(index, id, scanner); }));
          },
          py::arg("id"), py::arg("scanner") = "")
      .def(
          "score_labels",
          [](const Index& index, const CaseId& id, const fs::path& labels, const std::string& scanner) {
            return without_gil([&] {
              return score_scene(index.dataset, {id, scanner}, LabelsDirectory{labels.string()});
            });
          },
          py::arg("id"), py::arg("labels"), py::arg("scanner") = "", doc::experiment::score_scene);
}

}  // namespace tanglebin::python
