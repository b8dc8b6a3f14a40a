#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "tanglebin/export/export_files.hpp"
#include "tanglebin/export/scene.hpp"

// Internal to the room: what export_dataset() asks of a format.
namespace tanglebin {

/// Cases that are written together.
struct ExportUnit {
  std::size_t number;  ///< 1, 2, … in the export
  std::vector<CaseId> cases;
};

/// A format as functions. They may throw as SceneReader and ExportFiles do.
struct Format {
  std::size_t cases_per_unit = 1;

  /// The files of a unit: when all are there, it is done.
  std::function<std::vector<std::string>(const ExportUnit&)> files_of;

  /// Writes a unit, in a worker process.
  std::function<void(const ExportUnit&, const SceneReader&, ExportFiles&)> write;

  /// The files that are about all units.
  std::vector<std::string> common_files{};

  /// Writes these, once all units are done.
  std::function<void(const std::vector<ExportUnit>&, ExportFiles&)> assemble = [](const auto&, auto&) {};
};

Format coco_format(const Recipe& recipe);
Format numpy_format(const Recipe& recipe);
Format webdataset_format();
Format hdf5_format(const Recipe& recipe);
Format bop_format(const Recipe& recipe);

/// A format with one file for each view of a case, like A10/1.npz or A10/left/1.npz: `bytes_of` gives the
/// file.
Format file_per_view(const Recipe& recipe, const std::string& extension,
                     const std::function<std::string(const ExportScene&, const SceneView&)>& bytes_of);

/// The whole masks of a view as two arrays: the pixels of tube i + 1, as row * width + column, are numbers
/// starts[i] to starts[i + 1] - 1 of `pixels`.
struct PackedMasks {
  std::vector<std::uint32_t> starts;
  std::vector<std::uint32_t> pixels;
};
PackedMasks packed_whole_masks(const SceneView& view);

}  // namespace tanglebin
