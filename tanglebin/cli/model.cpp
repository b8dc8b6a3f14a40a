#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "tanglebin/base/bytes_of.hpp"
#include "tanglebin/base/error.hpp"
#include "tanglebin/cli/commands.hpp"
#include "tanglebin/cli/model_report.hpp"
#include "tanglebin/cli/options/arguments.hpp"
#include "tanglebin/cli/options/model_options.hpp"
#include "tanglebin/cli/options/outputs.hpp"
#include "tanglebin/cli/options/scene_options.hpp"
#include "tanglebin/cli/terminal/print.hpp"
#include "tanglebin/cloud/label_colors.hpp"
#include "tanglebin/files/safe_file.hpp"
#include "tanglebin/io/images.hpp"
#include "tanglebin/io/pcd.hpp"
#include "tanglebin/io/ply.hpp"
#include "tanglebin/model/model_tubes.hpp"
#include "tanglebin/model/model_with_steps.hpp"
#include "tanglebin/pictures/pictures_of_steps.hpp"
#include "tanglebin/scene/locate_support.hpp"
#include "tanglebin/scene/read_measurement.hpp"

namespace tanglebin::cli {
namespace {

struct ModelArguments {
  std::string cloud;
  std::string out;
  ModelFiles files;
  std::string method = name_of(Method::axis);
  std::string ratio = "1";
  ModelOptions model;
  SceneOptions scene;
  std::optional<std::string> debug_directory;
  bool locates = false;
  bool json = false;
};

std::string cloud_bytes(const PointCloud& cloud, const Model& model, const std::string& file) {
  return bytes_of([&](std::ostream& out) {
    if (is_pcd(file)) {
      write_pcd(out, labelled(cloud, model.labels));
    } else {
      write_ply(out, labelled(cloud, model.labels), "unit and frame of the input");
    }
  });
}

void print_summary(const ModelArguments& arguments, const ResolvedScene& scene, const Model& model) {
  if (arguments.json) {
    nlohmann::ordered_json json{{"cloud", arguments.out},
                                {"points", model.labels.size()},
                                {"radii", nlohmann::ordered_json::array()},
                                {"tubes", model.tubes.size()}};
    for (const TubeKind& kind : scene.known.kinds) json["radii"].push_back(kind.radius);
    for (const Step& step : model.steps) {
      json["steps"].push_back(
          {{"name", step.name}, {"seconds", step.seconds}, {"count", step.count}, {"of", step.of}});
    }
    json["notes"] = scene.notes;
    add_tubes(json, model);
    print_json_line(json);
    return;
  }
  for (const Step& step : model.steps) {
    print_out("{:<8} {:>8.3f} s  {:>7} {}\n", step.name, step.seconds, step.count, step.of);
  }
  print_tubes(model);
}

double ratio_of(const ModelArguments& arguments) {
  const std::vector<double> ratios = parse_ratios(arguments.ratio, "--downsample");
  if (ratios.size() != 1)
    throw InputError({"", 0, "--downsample"}, fmt::format("{} ratios", ratios.size()), "one");
  return ratios.front();
}

ModelSettings model_settings(const ModelArguments& arguments, const Profile& profile) {
  ModelSettings settings = settings_of(arguments.model, profile);
  settings.method = method_of(arguments.method);
  settings.ratio = ratio_of(arguments);
  return settings;
}

std::vector<NamedPicture> pictures_of(const MethodRun& run, const PaperModel& steps,
                                      const std::string& name) {
  return pictures_of_steps(run.cloud, steps, run.known.support, run.known.kinds[0].radius, name);
}

std::vector<NamedPicture> pictures_of(const MethodRun& run, const AxisModel& steps, const std::string& name) {
  return pictures_of_steps(run.cloud, steps, run.known.support, name);
}

void write_pictures(const std::vector<NamedPicture>& pictures, const std::filesystem::path& directory) {
  make_directories(directory);
  for (const auto& [name, picture] : pictures)
    write_file(directory / (name + ".png"), color_png(picture.width, picture.height, picture.pixels));
}

std::vector<Output> outputs(const ModelArguments& arguments) {
  std::vector<Output> files{{"--out", arguments.out, cloud_extensions}};
  for (Output& output : outputs(arguments.files)) files.push_back(std::move(output));
  return files;
}

ResolvedScene resolved_scene(const ModelArguments& arguments, const Measurement& measured) {
  if (!arguments.locates) return resolve(measured.scene, measured.cloud);
  const LocatedScene located = locate_support(measured.scene, measured.cloud);
  ResolvedScene resolved = resolve(located.scene, measured.cloud);
  resolved.notes.insert(resolved.notes.end(), located.doubts.begin(), located.doubts.end());
  return resolved;
}

void model_cloud(const ModelArguments& arguments) {
  expect_outputs(outputs(arguments),
                 inputs_with(arguments.scene.scene, {arguments.cloud, arguments.model.profile,
                                                     arguments.scene.camera.value_or("")}));
  const Profile profile = profile_of(arguments.model, {method_of(arguments.method)});
  const ModelSettings settings = model_settings(arguments, profile);
  const Scene told = scene_of(arguments.scene, arguments.cloud);
  const Measurement measured =
      read_input(arguments.cloud, [&](auto&&... from) { return read_measurement(from..., told); });
  const ResolvedScene resolved = with_places(arguments.scene, [&] {
    return with_file(arguments.cloud, [&] { return resolved_scene(arguments, measured); });
  });
  print_notes(resolved.notes);
  print_doubts(profile, resolved.known, arguments.model.profile);
  with_option("--method", "method", [&] { validate(resolved.known, settings); });
  std::vector<NamedPicture> pictures;
  const auto draw = [&](const MethodRun& run) {
    if (!arguments.debug_directory) return;
    pictures =
        std::visit([&](const auto& steps) { return pictures_of(run, steps, arguments.cloud); }, run.steps);
  };
  const Model model = with_file(
      arguments.cloud, [&] { return model_with_steps(resolved.cloud, resolved.known, settings, draw); });
  std::vector<std::pair<std::string, std::string>> files = contents(arguments.files, model);
  files.emplace_back(arguments.out, cloud_bytes(measured.cloud, model, arguments.out));
  write_outputs(files);
  if (arguments.debug_directory) write_pictures(pictures, *arguments.debug_directory);
  if (!take_standard_output(outputs(arguments))) print_summary(arguments, resolved, model);
  print_findings(model, arguments.cloud);
  expect_usable(model);
}

}  // namespace

void add_model(CLI::App& app) {
  const auto arguments = std::make_shared<ModelArguments>();
  CLI::App* command = app.add_subcommand("model", "Model the tubes in a cloud and label its points");
  command
      ->add_option("cloud", arguments->cloud,
                   "Cloud (PLY or PCD), or depth image (PNG or NPY) with its camera; - for standard input")
      ->required();
  command
      ->add_option("--out", arguments->out,
                   "The same cloud with labels: .ply or .pcd; - for PLY on standard output")
      ->required();
  add_options(*command, arguments->files);
  command->add_option("--method", arguments->method, "Method: axis or paper")->capture_default_str();
  command
      ->add_option("--downsample", arguments->ratio,
                   "Downsampling ratio: 0.3; points left out of the modelling are labelled too")
      ->capture_default_str();
  add_options(*command, arguments->model);
  add_scene_option(*command, arguments->scene.scene);
  add_camera_options(*command, arguments->scene);
  add_tube_options(*command, arguments->scene);
  command->add_flag("--locate", arguments->locates,
                    "First find the scene's bin or plane in the cloud (tanglebin locate)");
  command->add_option("--debug-dir", arguments->debug_directory,
                      "Directory for pictures of the result of each step");
  command->add_flag("--json", arguments->json, "Print steps, tubes, counts and findings as JSON");
  command->footer(
      "Example:\n  tanglebin model scan.ply --scene scene.toml --out labelled.ply --modelled-tubes "
      "tubes.txt\n"
      "  tanglebin model dataset/A10/plys/1.ply --scene dataset --out labelled.ply\n"
      "What is not given is estimated from the cloud, or the error says how to give it. Ignores the cloud's "
      "own labels and colours, and keeps a camera's colours. Methods: docs/algorithm.md.");
  command->callback([arguments] { model_cloud(*arguments); });
}

}  // namespace tanglebin::cli
