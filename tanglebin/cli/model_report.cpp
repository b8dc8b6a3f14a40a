#include "tanglebin/cli/model_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <string_view>
#include <utility>
#include <vector>

#include "tanglebin/base/bytes_of.hpp"
#include "tanglebin/cli/options/arguments.hpp"
#include "tanglebin/cli/terminal/exit_status.hpp"
#include "tanglebin/cli/terminal/print.hpp"
#include "tanglebin/io/configuration.hpp"
#include "tanglebin/io/mesh.hpp"
#include "tanglebin/model/tubes_json.hpp"

namespace tanglebin::cli {
namespace {

// Whether a file's name has this extension, in upper or lower case.
bool has_extension(const std::string& file, std::string_view extension) {
  return std::ranges::equal(std::filesystem::path(file).extension().string(), extension, {}, [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
}

std::string tubes_bytes(const Model& model, const std::string& file) {
  if (has_extension(file, ".json")) return tubes_json(model) + '\n';
  return bytes_of([&](std::ostream& out) { write_configuration(out, model.tubes); });
}

std::string mesh_bytes(const Model& model, const std::string& file) {
  std::vector<TubeMesh> meshes;
  for (const Tube& tube : model.tubes) meshes.push_back(mesh_of(tube));
  return bytes_of([&](std::ostream& out) {
    has_extension(file, ".obj") ? write_mesh_obj(out, meshes) : write_mesh_ply(out, meshes);
  });
}

// The odds of the join that is least sure; nothing without joins.
std::string weakest_join(const TubeEvidence& evidence) {
  if (evidence.joins.empty()) return "-";
  const TubeJoin& weakest = *std::ranges::min_element(evidence.joins, {}, &TubeJoin::margin);
  return fmt::format("{:.1f}", weakest.margin);
}

std::string text_of(LengthFit fit) {
  std::string text = name_of(fit);
  std::ranges::replace(text, '_', ' ');
  return text;
}

void print_counts(const PointCounts& counts) {
  const std::vector<std::pair<const char*, std::size_t>> all{
      {"on tubes", counts.on_tubes},
      {"on the support", counts.on_support},
      {"near the support", counts.near_support},
      {"unexplained", counts.unexplained},
      {"under the support", counts.below_support},
      {"too far away", counts.cropped},
      {"behind the camera", counts.behind_camera},
      {"outside of the camera's image", counts.outside_image},
      {"without a position", counts.invalid}};
  std::vector<std::string> parts;
  for (const auto& [what, count] : all) {
    if (count > 0) parts.push_back(fmt::format("{} {}", count, what));
  }
  print_out("{} points{}{}\n", counts.all, parts.empty() ? "" : ": ",
            fmt::format("{}", fmt::join(parts, ", ")));
}

}  // namespace

void add_options(CLI::App& command, ModelFiles& files) {
  command.add_option(
      "--modelled-tubes", files.tubes,
      "Also write the tubes: .txt, or .json with how sure they are (docs/formats.md); - for .txt on "
      "standard output");
  command.add_option("--mesh", files.mesh, "Also write the tubes' surfaces: .ply or .obj");
}

std::vector<Output> outputs(const ModelFiles& files) {
  std::vector<Output> all;
  if (files.tubes) all.push_back({"--modelled-tubes", *files.tubes, {".txt", ".json"}});
  if (files.mesh) all.push_back({"--mesh", *files.mesh, {".ply", ".obj"}});
  return all;
}

std::vector<std::pair<std::string, std::string>> contents(const ModelFiles& files, const Model& model) {
  std::vector<std::pair<std::string, std::string>> all;
  if (files.tubes) all.emplace_back(*files.tubes, tubes_bytes(model, *files.tubes));
  if (files.mesh) all.emplace_back(*files.mesh, mesh_bytes(model, *files.mesh));
  return all;
}

void print_tubes(const Model& model) {
  print_counts(model.counts);
  for (const EstimatedLength& estimate : model.estimated_lengths)
    print_out("the length is estimated: {:.3f} m\n", estimate.length);
  if (model.tubes.empty()) return;
  print_out("{:>4} {:>10} {:>8} {:>9} {:>9} {:>5} {:>7} {:>9} {:>6} {:>12}\n", "tube", "confidence", "radius",
            "length", "", "seen", "points", "residual", "joins", "weakest join");
  for (std::size_t i = 0; i < model.tubes.size(); ++i) {
    const TubeEvidence& evidence = model.evidence[i];
    print_out("{:>4} {:>10.3f} {:>5.1f} mm {:>7.3f} m {:>9} {:>3.0f} % {:>7} {:>6.2f} mm {:>6} {:>12}\n",
              model.tubes[i].id, evidence.confidence, 1000 * model.tubes[i].radius, evidence.length,
              text_of(evidence.length_fit), 100 * evidence.coverage(), evidence.points,
              1000 * evidence.residual, evidence.joins.size(), weakest_join(evidence));
  }
}

void add_tubes(nlohmann::ordered_json& json, const Model& model) {
  nlohmann::ordered_json all = nlohmann::ordered_json::parse(tubes_json(model));
  json["usable"] = all["usable"];
  json["counts"] = all["points"];
  json["findings"] = all["findings"];
  json["estimated_lengths"] = all["estimated_lengths"];
  json["found"] = all["tubes"];
}

void print_findings(const Model& model, const std::string& cloud) {
  for (const Finding& finding : model.findings) {
    const bool is_error = finding.severity == Finding::Severity::error;
    print_error("tanglebin: {}: {}{}\n", cloud, is_error ? "" : "warning: ", finding.message);
  }
}

void expect_usable(const Model& model) {
  if (model.is_refused()) throw CLI::RuntimeError(exit_nothing_found);
}

}  // namespace tanglebin::cli
