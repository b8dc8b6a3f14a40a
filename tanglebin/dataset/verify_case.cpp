#include "tanglebin/dataset/verify_case.hpp"

#include <fmt/core.h>
#include <tinyxml2.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string_view>
#include <utility>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/random.hpp"
#include "tanglebin/dataset/case_files.hpp"
#include "tanglebin/dataset/dataset.hpp"
#include "tanglebin/files/json_record.hpp"
#include "tanglebin/geometry/mass_properties.hpp"
#include "tanglebin/io/configuration.hpp"
#include "tanglebin/io/grey_png.hpp"
#include "tanglebin/io/pcd.hpp"
#include "tanglebin/io/ply.hpp"
#include "tanglebin/settle/overlap.hpp"

namespace tanglebin {
namespace {

namespace fs = std::filesystem;

bool is_of_kind(const std::string& path, std::string_view kind) {
  return fs::path(path).parent_path().filename() == kind;
}

// The camera of the scanner in whose folder the file is.
const Camera& camera_of(const Recipe& recipe, const std::string& path) {
  const std::string folder = fs::path(path).parent_path().parent_path().filename().string();
  const auto found = std::ranges::find(recipe.further_scanners, folder, &Scanner::name);
  return found == recipe.further_scanners.end() ? recipe.camera : found->camera;
}

// How many points the manifest says that this scanner's cloud has.
std::size_t points_of(const CaseRecord& record, const std::string& path) {
  const std::string folder = fs::path(path).parent_path().parent_path().filename().string();
  const auto found = std::ranges::find(record.scanners, folder, &ScannerRecord::name);
  return found == record.scanners.end() ? record.points : found->points;
}

std::string text_of(const std::vector<DrawnNumber>& drawn) {
  std::string text;
  for (const auto& [path, value, tube] : drawn)
    text += fmt::format("{}{}{} = {}", text.empty() ? "" : ", ",
                        tube == 0 ? "" : fmt::format("tube {}: ", tube), path, value);
  return text.empty() ? "none" : text;
}

/// One case under inspection.
class Inspection {
public:
  Inspection(const fs::path& directory, const Recipe& recipe, const CaseRecord& record)
      : directory_(directory), recipe_(recipe), record_(record) {}

  void inspect_files() {
    const std::vector<std::string> own = paths_of(recipe_, record_.id);
    for (const std::string& path : own) {
      if (std::ranges::find(record_.files, path, &FileRecord::path) == record_.files.end())
        add(case_name(), fmt::format("has no file {}", path));
    }
    for (const FileRecord& file : record_.files) {
      if (std::ranges::find(own, file.path) != own.end()) {
        inspect_file(file);
      } else {
        add(case_name(), fmt::format("has {}, which is none of its own files", file.path));
      }
    }
  }

  void inspect_numbers(const std::vector<DrawnNumber>& drawn) {
    const int attempt = static_cast<int>(record_.rejections.size()) + 1;
    const auto& [set, tubes, number] = record_.id;
    const std::uint64_t seed = attempt_seed(recipe_.seed, set, tubes, number, attempt);
    if (record_.seed != seed) {
      add(case_name(), fmt::format("seed: found {:016x}, expected {:016x}", record_.seed, seed));
    }
    if (record_.drawn != drawn) {
      add(case_name(), fmt::format("drawn: found {}, expected {}", text_of(record_.drawn), text_of(drawn)));
    }
  }

  void inspect_heap(bool rest) {
    if (tubes_.empty()) return;
    const double limit = recipe_.settle.overlap_max + rounding;
    const double overlap = largest_tube_overlap(tubes_);
    if (overlap > limit) add(case_name(), fmt::format("two tubes overlap by {:.3f} mm", 1e3 * overlap));
    const double in_bin = largest_bin_overlap(tubes_, recipe_.bin);
    if (in_bin > limit) add(case_name(), fmt::format("a tube overlaps the bin by {:.3f} mm", 1e3 * in_bin));
    for (const Tube& tube : tubes_) inspect_place(tube);
    if (rest && faults_.empty()) {
      add_if_any(case_name(), fault_of_heap(tubes_, recipe_.bin, recipe_.settle));
    }
  }

  std::vector<DatasetFault> take_faults() { return std::move(faults_); }

private:
  static constexpr double rounding = 1e-8;  // m: positions are whole nanometres

  std::string case_name() const { return name_of(record_.id); }

  void add(std::string where, std::string what) { faults_.push_back({std::move(where), std::move(what)}); }
  void add_if_any(std::string where, std::string what) {
    if (!what.empty()) add(std::move(where), std::move(what));
  }

  void inspect_file(const FileRecord& file) {
    try {
      read(file.path, checked_bytes(directory_, file));
    } catch (const InputError& error) {
      add(file.path, complaint_of(error));
    }
  }

  void read(const std::string& path, const std::string& bytes) {
    const std::string name = (directory_ / path).string();
    std::istringstream in(bytes);
    if (is_of_kind(path, "plys")) {
      inspect_cloud(path, read_ply(in, name));
    } else if (is_of_kind(path, "pcds")) {
      inspect_cloud_labels(path, read_pcd(in, name));
    } else if (is_of_kind(path, "tube_configurations")) {
      inspect_tubes(path, read_configuration(in, name));
    } else if (is_of_kind(path, "gazebo_worlds")) {
      add_if_any(path, fault_of_world(bytes));
    } else if (path.ends_with(".json")) {
      if (parse_json(bytes, {name, 0, ""}).is_discarded()) add(path, "not JSON");
    } else if (path.ends_with(".png")) {
      const Camera& camera = camera_of(recipe_, path);
      add_if_any(path, fault_of_png(bytes, camera.width, camera.height));
    }
  }

  void inspect_cloud(const std::string& path, const PointCloud& cloud) {
    if (const std::size_t expected = points_of(record_, path); cloud.points.size() != expected) {
      add(path,
          fmt::format("found {} points, expected {}, as the manifest says", cloud.points.size(), expected));
    }
    inspect_cloud_labels(path, cloud);
  }

  void inspect_cloud_labels(const std::string& path, const PointCloud& cloud) {
    const auto is_wrong = [&](int label) { return label < null_label || label > record_.id.tubes; };
    const auto wrong = std::ranges::find_if(cloud.labels, is_wrong);
    if (wrong != cloud.labels.end()) {
      add(path, fmt::format("found label {}, expected at most {}", *wrong, record_.id.tubes));
    }
  }

  void inspect_tubes(const std::string& path, std::vector<Tube> tubes) {
    if (tubes.size() != static_cast<std::size_t>(record_.id.tubes)) {
      add(path, fmt::format("found {} tubes, expected {}", tubes.size(), record_.id.tubes));
    }
    const SetRecipe& set = set_named(recipe_, record_.id.set);
    for (Tube& tube : tubes) {
      const TubeSpec& kind = kind_of(set, tube.id);
      if (tube.radius != kind.radius) {
        add(path,
            fmt::format("tube {}: found a radius of {} m, expected {} m", tube.id, tube.radius, kind.radius));
      }
      tube.mass = mass_of(tube, kind);  // the format does not carry it
    }
    tubes_ = std::move(tubes);
  }

  void inspect_place(const Tube& tube) {
    const Eigen::Vector3d centre = mass_properties(tube).centre;
    const bool is_inside = std::abs(centre.x()) < recipe_.bin.length / 2 &&
                           std::abs(centre.y()) < recipe_.bin.width / 2 && centre.z() > 0;
    if (!is_inside) {
      add(case_name(),
          fmt::format("tube {}: its centre of mass, ({:.4f}, {:.4f}, {:.4f}) m, is not in the bin", tube.id,
                      centre.x(), centre.y(), centre.z()));
    }
  }

  const fs::path& directory_;
  const Recipe& recipe_;
  const CaseRecord& record_;
  std::vector<Tube> tubes_;
  std::vector<DatasetFault> faults_;
};

}  // namespace

std::string complaint_of(const InputError& error) {
  const InputPlace& place = error.place();
  return (place.line > 0 ? fmt::format("line {}: ", place.line) : "") +
         (place.field.empty() ? "" : place.field + ": ") + error.problem();
}

std::string fault_of_world(const std::string& bytes) {
  tinyxml2::XMLDocument document;
  if (document.Parse(bytes.data(), bytes.size()) != tinyxml2::XML_SUCCESS) {
    return fmt::format("no XML: {}", tinyxml2::XMLDocument::ErrorIDToName(document.ErrorID()));
  }
  const tinyxml2::XMLElement* root = document.RootElement();
  const bool is_world = root != nullptr && std::string_view(root->Name()) == "sdf" &&
                        root->FirstChildElement("world") != nullptr;
  return is_world ? "" : "no SDF world";
}

std::string fault_of_png(const std::string& bytes, int width, int height) {
  try {
    const GreyImage image = grey_image_from_png(bytes, "");
    if (image.width == width && image.height == height) return "";
    return fmt::format("found {} x {} pixels, expected {} x {}", image.width, image.height, width, height);
  } catch (const InputError& error) {
    return error.problem();
  }
}

std::vector<DatasetFault> faults_of_case(const fs::path& directory, const Recipe& recipe,
                                         const CaseRecord& record, bool rest) {
  const std::vector<DrawnNumber> drawn = draw(recipe, record.id);
  const Recipe resolved = resolve(recipe, record.id, drawn);
  Inspection inspection(directory, resolved, record);
  inspection.inspect_numbers(drawn);
  inspection.inspect_files();
  inspection.inspect_heap(rest);
  return inspection.take_faults();
}

}  // namespace tanglebin
