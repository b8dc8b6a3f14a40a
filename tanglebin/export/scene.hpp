#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "tanglebin/dataset/dataset.hpp"
#include "tanglebin/files/json_record.hpp"
#include "tanglebin/scan/occlusion.hpp"
#include "tanglebin/scan/scan.hpp"
#include "tanglebin/settle/contacts.hpp"

namespace tanglebin {

/// What a scanner sees of a case.
struct SceneView {
  std::string scanner;           ///< its name; empty for the only one of a recipe
  Scan scan;                     ///< the dataset's own, made again
  std::vector<WholeView> whole;  ///< of each tube
  Occlusions occlusions;
};

/// Where a case is among all cases of its recipe, whether they are made or not.
struct CasePlace {
  std::size_t number;        ///< 1, 2, …
  std::size_t tubes_before;  ///< how many tubes the cases before it have
};

/// Where each case of a recipe is.
std::map<CaseId, CasePlace> case_places(const Recipe& recipe);

/// A case of a dataset, to be exported.
struct ExportScene {
  CaseId id;
  CasePlace place;
  std::uint64_t seed;       ///< of the attempt that made it
  Recipe recipe;            ///< the case's own, without random numbers
  std::vector<Tube> tubes;  ///< 1, 2, … in this order
  std::vector<Contact> contacts;
  std::vector<SceneView> views;  ///< in the order of the recipe's scanners
};

/// Reads the cases of a dataset and scans them again, so it does not matter which clouds and images the
/// dataset has.
class SceneReader {
public:
  explicit SceneReader(const Dataset& dataset);

  /// Throws InputError if a file of the case is missing or not as the manifest says, and if a scan has
  /// another number of points: it was made by another version of Tanglebin.
  ExportScene read(const CaseId& id) const;

private:
  const Dataset& dataset_;
  std::map<CaseId, CasePlace> places_;
};

/// "A10-000001", or "A10-000001-left" of a scanner that has a name: names a view in files, without dots.
std::string view_name(const CaseId& id, const std::string& scanner);

/// What a case's view is, and what hides and touches what: the JSON that all formats have (docs/export.md).
Json view_json(const ExportScene& scene, const SceneView& view);

}  // namespace tanglebin
