#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "tanglebin/base/error.hpp"
#include "tanglebin/cli/arguments.hpp"
#include "tanglebin/cli/commands.hpp"
#include "tanglebin/cli/model_options.hpp"
#include "tanglebin/cli/outputs.hpp"
#include "tanglebin/cli/print.hpp"
#include "tanglebin/cloud/label_colors.hpp"
#include "tanglebin/geometry/labels.hpp"
#include "tanglebin/io/configuration.hpp"
#include "tanglebin/io/images.hpp"
#include "tanglebin/io/pcd.hpp"
#include "tanglebin/io/ply.hpp"
#include "tanglebin/io/read_cloud.hpp"
#include "tanglebin/io/safe_file.hpp"
#include "tanglebin/model/axis/axis_method.hpp"
#include "tanglebin/model/axis/radius.hpp"
#include "tanglebin/model/model_tubes.hpp"
#include "tanglebin/model/paper/paper_method.hpp"
#include "tanglebin/report/pictures_of_steps.hpp"

namespace tanglebin::cli {
namespace {

struct ModelArguments {
  std::string cloud;
  std::string out;
  std::optional<std::string> tubes;
  std::string method = name_of(Method::axis);
  std::string ratio = "1";
  ModelOptions model;
  std::string bin = "paper";
  std::string scanner = "paper";
  std::string radius = fmt::format("{}", TubeKind().radius);
  std::string length = fmt::format("{}", TubeKind().length());
  std::vector<std::string> trees;
  std::optional<std::string> debug_directory;
  bool json = false;
};

// For each kind of tube, or one for all.
std::vector<SegmentTree> known_segments(const ModelArguments& arguments) {
  std::vector<SegmentTree> segments;
  for (const std::string& tree : arguments.trees) segments.push_back(parse_tree(tree, "--tree"));
  if (!segments.empty()) return segments;
  for (const double length : parse_lengths(arguments.length, "--length"))
    segments.push_back({{1, 2, length}});
  return segments;
}

KnownScene known_scene(const ModelArguments& arguments, const PointCloud& cloud) {
  KnownScene known{.support = {.bin = bin_preset(arguments.bin)}, .camera = camera_preset(arguments.scanner)};
  const std::vector<double> radii =
      arguments.radius == "auto"
          ? std::vector{with_file(arguments.cloud, [&] { return estimate_radius(cloud, known).radius; })}
          : parse_lengths(arguments.radius, "--radius");
  const std::vector<SegmentTree> segments = known_segments(arguments);
  if (segments.size() != 1 && segments.size() != radii.size()) {
    const std::string what = arguments.trees.empty() ? "length" : "tree";
    throw InputError({"", 0, "--" + what}, fmt::format("{} {}s", segments.size(), what),
                     fmt::format("one, or one for each radius: {}", radii.size()));
  }
  known.kinds.clear();
  for (std::size_t i = 0; i < radii.size(); ++i)
    known.kinds.push_back({.radius = radii[i], .segments = segments[segments.size() == 1 ? 0 : i]});
  return known;
}

// The cloud's points in their order, with the labels found. PLY cannot store points without a position, which
// organized clouds have.
PointCloud labelled_cloud(const PointCloud& cloud, const Model& model, bool keep_missing_points) {
  const std::vector<Color> colors = label_colors(static_cast<int>(model.tubes.size()));
  PointCloud labelled;
  labelled.viewpoint = cloud.viewpoint;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (!keep_missing_points && !cloud.points[i].allFinite()) continue;
    const std::int32_t label = model.labels[i];
    labelled.points.push_back(cloud.points[i]);
    labelled.labels.push_back(label);
    labelled.colors.push_back(label == null_label ? null_color : colors[static_cast<std::size_t>(label)]);
  }
  labelled.width = keep_missing_points ? cloud.width : labelled.points.size();
  labelled.height = keep_missing_points ? cloud.height : 1;
  return labelled;
}

std::string cloud_bytes(const PointCloud& cloud, const Model& model, const std::string& file) {
  std::ostringstream out;
  if (is_pcd(file)) {
    write_pcd(out, labelled_cloud(cloud, model, true));
  } else {
    write_ply(out, labelled_cloud(cloud, model, false));
  }
  return std::move(out).str();
}

void print_summary(const ModelArguments& arguments, const KnownScene& known, const Model& model) {
  if (arguments.json) {
    nlohmann::ordered_json json{{"cloud", arguments.out},
                                {"points", model.labels.size()},
                                {"radii", nlohmann::ordered_json::array()},
                                {"tubes", model.tubes.size()}};
    for (const TubeKind& kind : known.kinds) json["radii"].push_back(kind.radius);
    for (const Step& step : model.steps) {
      json["steps"].push_back(
          {{"name", step.name}, {"seconds", step.seconds}, {"count", step.count}, {"of", step.of}});
    }
    print_json_line(json);
    return;
  }
  if (arguments.radius == "auto") print_out("radius   {:>8.5f} m\n", known.kinds[0].radius);
  for (const Step& step : model.steps) {
    print_out("{:<8} {:>8.3f} s  {:>7} {}\n", step.name, step.seconds, step.count, step.of);
  }
}

double ratio_of(const ModelArguments& arguments) {
  const std::vector<double> ratios = parse_ratios(arguments.ratio, "--downsample");
  if (ratios.size() != 1)
    throw InputError({"", 0, "--downsample"}, fmt::format("{} ratios", ratios.size()), "one");
  return ratios.front();
}

ModelSettings model_settings(const ModelArguments& arguments) {
  ModelSettings settings = settings_of(arguments.model);
  settings.method = method_named(arguments.method);
  settings.ratio = ratio_of(arguments);
  return settings;
}

std::vector<NamedPicture> pictures(const PointCloud& cloud, const KnownScene& known,
                                   const ModelSettings& settings, const std::string& name) {
  const auto& [method, ratio, seed, axis, paper] = settings;
  switch (method) {
    case Method::paper:
      return pictures_of_steps(cloud, model_as_in_paper(cloud, known, ratio, seed, paper), known.support.bin,
                               known.kinds[0].radius, name);
    case Method::axis:
      return pictures_of_steps(cloud, model_by_axes(cloud, known, ratio, seed, axis), known.support.bin,
                               name);
  }
  return {};
}

void write_pictures(const PointCloud& cloud, const KnownScene& known, const ModelSettings& settings,
                    const ModelArguments& arguments) {
  make_directories(*arguments.debug_directory);
  for (const auto& [name, picture] : pictures(cloud, known, settings, arguments.cloud)) {
    write_file(std::filesystem::path(*arguments.debug_directory) / (name + ".png"),
               color_png(picture.width, picture.height, picture.pixels));
  }
}

std::vector<Output> outputs(const ModelArguments& arguments) {
  std::vector<Output> files{{"--out", arguments.out, cloud_extensions}};
  if (arguments.tubes) files.push_back({"--modelled-tubes", *arguments.tubes, {".txt"}});
  return files;
}

void model_cloud(const ModelArguments& arguments) {
  expect_outputs(outputs(arguments));
  const ModelSettings settings = model_settings(arguments);
  const PointCloud cloud = read_input(arguments.cloud, [](auto&&... from) { return read_cloud(from...); });
  const KnownScene known = known_scene(arguments, cloud);
  validate(known, settings);
  const Model model = with_file(arguments.cloud, [&] { return model_tubes(cloud, known, settings); });
  write_output(arguments.out, cloud_bytes(cloud, model, arguments.out));
  if (arguments.tubes) {
    std::ostringstream tubes;
    write_configuration(tubes, model.tubes);
    write_output(*arguments.tubes, tubes.str());
  }
  if (arguments.debug_directory) write_pictures(cloud, known, settings, arguments);
  if (!take_standard_output(outputs(arguments))) print_summary(arguments, known, model);
}

}  // namespace

void add_model(CLI::App& app) {
  const auto arguments = std::make_shared<ModelArguments>();
  CLI::App* command = app.add_subcommand("model", "Model the tubes in a cloud and label its points");
  command->add_option("cloud", arguments->cloud, "Cloud (PLY or PCD); - for standard input")->required();
  command
      ->add_option("--out", arguments->out,
                   "The same cloud with labels: .ply or .pcd; - for PLY on standard output")
      ->required();
  command->add_option("--modelled-tubes", arguments->tubes,
                      "Also write the tubes: .txt (docs/formats.md); - for standard output");
  command->add_option("--method", arguments->method, "Method: axis or paper")->capture_default_str();
  command
      ->add_option("--downsample", arguments->ratio,
                   "Downsampling ratio: 0.3; points left out of the modelling are labelled too")
      ->capture_default_str();
  add_options(*command, arguments->model);
  command->add_option("--bin", arguments->bin, "Bin: paper or published")->capture_default_str();
  command
      ->add_option("--scanner", arguments->scanner, "Camera: paper, gaussian, zivid-one-plus-l or kinect-v1")
      ->capture_default_str();
  command
      ->add_option(
          "--radius", arguments->radius,
          "Radius of the tubes, m; 0.008,0.0125 for two kinds of tubes; auto to estimate it from the cloud")
      ->capture_default_str();
  CLI::Option* const length =
      command->add_option("--length", arguments->length, "Length of the tubes, m; 0.4,0.5 for two radii");
  length->capture_default_str();
  command
      ->add_option(
          "--tree", arguments->trees,
          "Segments of branching tubes, as pairs of nodes with a length, m: 1-2:0.3,1-3:0.1,1-4:0.1; repeat "
          "the option for each radius (method axis)")
      ->allow_extra_args(false)
      ->excludes(length);
  command->add_option("--debug-dir", arguments->debug_directory,
                      "Directory for pictures of the result of each step");
  command->add_flag("--json", arguments->json, "Print the steps as JSON");
  command->footer(
      "Example:\n  tanglebin model dataset/A10/plys/1.ply --out labelled.ply --modelled-tubes tubes.txt\n"
      "Ignores the cloud's own labels and colours. Methods: docs/algorithm.md.");
  command->callback([arguments] { model_cloud(*arguments); });
}

}  // namespace tanglebin::cli
