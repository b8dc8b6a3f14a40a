#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tanglebin/base/bytes_of.hpp"
#include "tanglebin/base/error.hpp"
#include "tanglebin/cli/commands.hpp"
#include "tanglebin/cli/options/arguments.hpp"
#include "tanglebin/cli/options/outputs.hpp"
#include "tanglebin/cli/options/scene_options.hpp"
#include "tanglebin/cli/terminal/print.hpp"
#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/geometry/bin.hpp"
#include "tanglebin/geometry/view_of_bin.hpp"
#include "tanglebin/io/configuration.hpp"
#include "tanglebin/io/images.hpp"
#include "tanglebin/io/pcd.hpp"
#include "tanglebin/io/ply.hpp"
#include "tanglebin/pictures/picture_of_scan.hpp"
#include "tanglebin/recipe/recipe.hpp"
#include "tanglebin/report/text.hpp"
#include "tanglebin/scan/scan_output.hpp"
#include "tanglebin/scan/scanner.hpp"

namespace tanglebin::cli {
namespace {

struct ScanArguments {
  std::string configuration;
  std::string out;
  std::optional<std::string> scene;
  std::string bin = "paper";
  std::optional<std::string> scanner;
  std::vector<std::string> parameters;
  std::string seed = "0";
  bool with_bin = false;
  std::optional<std::string> depth;
  std::optional<std::string> labels;
  std::optional<std::string> picture;
  PointProperties properties;
  bool json = false;
};

int largest_id(const std::vector<Tube>& tubes) {
  int largest = 0;
  for (const Tube& tube : tubes) largest = std::max(largest, tube.id);
  return largest;
}

void warn_of_no_tube(const Camera& camera, const std::vector<Tube>& tubes) {
  Eigen::AlignedBox3d box;
  for (const Tube& tube : tubes) box.extend(bounds(tube));
  const auto text = [](const Eigen::Vector3d& point) {
    return fmt::format("({:.4g}, {:.4g}, {:.4g})", point.x(), point.y(), point.z());
  };
  print_error(
      "tanglebin: warning: the scan has no point of a tube; the tubes are between {} and {} m, the camera at "
      "{}\n",
      text(box.min()), text(box.max()), text(camera.pose.translation()));
}

// PLY, or an organized PCD.
std::string cloud_bytes(const ScanArguments& arguments, const Scan& view, int tubes) {
  const CloudOf what = arguments.with_bin ? CloudOf::tubes_and_bin : CloudOf::tubes;
  return bytes_of([&](std::ostream& out) {
    if (is_pcd(arguments.out)) {
      write_pcd(out, organized_cloud_from_scan(view, what, tubes, arguments.properties));
    } else {
      write_ply(out, cloud_from_scan(view, what, tubes, arguments.properties));
    }
  });
}

void print_summary(const ScanArguments& arguments, const Scan& view, const std::vector<Tube>& tubes) {
  std::vector<std::size_t> points(static_cast<std::size_t>(largest_id(tubes)) + 1);
  for (const Pixel& pixel : view.pixels) {
    if (pixel.label != null_label) ++points[static_cast<std::size_t>(pixel.label)];
  }
  if (arguments.json) {
    nlohmann::ordered_json json{{"cloud", arguments.out}, {"bin_points", points[bin_label]}};
    for (const Tube& tube : tubes) {
      json["tubes"].push_back({{"label", tube.id}, {"points", points[static_cast<std::size_t>(tube.id)]}});
    }
    print_json_line(json);
    return;
  }
  std::size_t tube_points = 0;
  for (const Tube& tube : tubes) tube_points += points[static_cast<std::size_t>(tube.id)];
  print_out("{}: {} on {}, {} on the bin{}\n", arguments.out, counted(tube_points, "point"),
            counted(tubes.size(), "tube"), points[bin_label], arguments.with_bin ? "" : " (left out)");
}

std::string camera_file(const std::string& depth) {
  return std::filesystem::path(depth).replace_extension(".json").string();
}

std::vector<Output> outputs(const ScanArguments& arguments) {
  std::vector<Output> files{{"--out", arguments.out, cloud_extensions}};
  if (arguments.depth) {
    if (*arguments.depth == standard_stream)
      throw InputError({"", 0, "--depth"}, "'-'", "a file's name, because the camera is written beside it");
    files.push_back({"--depth", *arguments.depth, {".png"}});
    files.push_back({"--depth", camera_file(*arguments.depth), {".json"}});
  }
  if (arguments.labels) files.push_back({"--labels", *arguments.labels, {".png"}});
  if (arguments.picture) files.push_back({"--picture", *arguments.picture, {".png"}});
  return files;
}

// The files with their contents.
std::vector<std::pair<std::string, std::string>> contents(const ScanArguments& arguments,
                                                          const std::vector<Tube>& tubes,
                                                          const Support& support, const Scan& view) {
  std::vector<std::pair<std::string, std::string>> files{
      {arguments.out, cloud_bytes(arguments, view, largest_id(tubes))}};
  if (arguments.depth) {
    files.emplace_back(*arguments.depth, depth_png(depth_image(view)));
    files.emplace_back(camera_file(*arguments.depth), camera_json(view.camera));
  }
  if (arguments.labels) files.emplace_back(*arguments.labels, label_png(label_image(view)));
  if (arguments.picture) {
    const Picture picture = picture_of_scan(scan(tubes, support, view.camera), view, arguments.configuration);
    files.emplace_back(*arguments.picture, color_png(picture.width, picture.height, picture.pixels));
  }
  return files;
}

/// What to scan with, and what the tubes lie in or on.
struct Setting {
  Scanner scanner;
  Support support;
};

// A scene's camera takes the place of the scanner's, whose sensor stays.
void take_camera(const SceneCamera& camera, const ScanArguments& arguments, Scanner& scanner) {
  if (!camera.intrinsics && !camera.pose) return;
  if (!camera.intrinsics || !camera.pose || camera.intrinsics->width == 0)
    throw InputError({*arguments.scene, 0, "camera"},
                     "a camera without pose, intrinsics or the size of its image", "all of them, or none");
  scanner.camera = camera_with(*camera.intrinsics, *camera.pose);
  if (arguments.scanner)
    print_error("tanglebin: the camera is the scene's; only the sensor is that of --scanner {}\n",
                *arguments.scanner);
}

// The scanner of a dataset's case or a recipe is the scene's, unless another one is asked for.
std::optional<Scanner> own_scanner(const ScanArguments& arguments) {
  if (arguments.scanner) return std::nullopt;
  const std::optional<Scanner> own = scanner_in(*arguments.scene, arguments.configuration);
  return own ? std::optional(scanner_with(*own, arguments.parameters, "--parameter")) : std::nullopt;
}

Scanner preset_scanner(const ScanArguments& arguments) {
  const std::string preset = arguments.scanner.value_or("paper");
  with_place({"", 0, "--scanner"}, [&] { return camera_preset(preset); });
  return scanner_with(preset, arguments.parameters, "--parameter");
}

Setting setting_of(const ScanArguments& arguments) {
  Setting setting{
      .scanner = preset_scanner(arguments),
      .support = {.bin = with_place({"", 0, "--bin"}, [&] { return bin_preset(arguments.bin); })}};
  if (arguments.scene) {
    const Scene scene = scene_named(*arguments.scene, arguments.configuration);
    setting.support = scene.support.value_or(Support{.shape = Support::Shape::nothing});
    if (const auto own = own_scanner(arguments))
      setting.scanner = *own;
    else
      take_camera(scene.camera, arguments, setting.scanner);
  }
  if (setting.support.shape == Support::Shape::bin) {
    Camera camera = setting.scanner.camera;
    camera.pose = setting.support.pose.inverse() * camera.pose;
    validate(camera, setting.support.bin);
  }
  return setting;
}

void scan_configuration(const ScanArguments& arguments) {
  expect_outputs(outputs(arguments), inputs_with(arguments.scene, {arguments.configuration}));
  const auto [scanner, support] = setting_of(arguments);
  const std::uint64_t seed = parse_seed(arguments.seed, "--seed");
  const std::vector<Tube> tubes =
      read_input(arguments.configuration, [](auto&&... from) { return read_configuration(from...); });
  const Scan view = scan(tubes, support, scanner.camera, scanner.sensor, seed, scanner.name);
  if (!tubes.empty() && !shows_a_tube(view)) warn_of_no_tube(scanner.camera, tubes);
  write_outputs(contents(arguments, tubes, support, view));
  if (!take_standard_output(outputs(arguments))) print_summary(arguments, view, tubes);
}

}  // namespace

void add_scan(CLI::App& app) {
  const auto arguments = std::make_shared<ScanArguments>();
  CLI::App* command = app.add_subcommand("scan", "Scan a tube configuration into a labelled cloud");
  command
      ->add_option("configuration", arguments->configuration,
                   "Tube configuration (text); - for standard input")
      ->required();
  command
      ->add_option("--out", arguments->out,
                   "Cloud: .ply, or .pcd for an organized cloud; - for PLY on standard output")
      ->required();
  add_scene_option(*command, arguments->scene);
  command->add_option("--bin", arguments->bin, "Bin, without a scene: paper or published")
      ->capture_default_str()
      ->excludes("--scene");
  command
      ->add_option("--scanner", arguments->scanner,
                   fmt::format("Scanner: {}; its camera too, unless the scene has one; without this, the "
                               "scene's scanner, or paper, which is ideal",
                               fmt::join(scanner_presets(), ", ")))
      ->option_text("NAME");
  command
      ->add_option("--parameter", arguments->parameters,
                   "Set a parameter of the scanner, such as scanner.baseline=0.3 (docs/sensor.md)")
      ->allow_extra_args(false)
      ->option_text("NAME=VALUE");
  command
      ->add_option("--seed", arguments->seed,
                   "Seed of the scanner's noise, such as a scene's in a manifest: decimal, or hexadecimal "
                   "after 0x")
      ->capture_default_str();
  command->add_flag("--with-bin", arguments->with_bin, "Include the points on the bin, with label 0");
  command->add_option("--depth", arguments->depth,
                      "Also write a 16-bit depth image (PNG), with its camera beside it (JSON)");
  command->add_option("--labels", arguments->labels, "Also write a 16-bit label image (PNG)");
  command->add_option("--picture", arguments->picture,
                      "Also write a picture (PNG): depth, labels, signal and error, beside an ideal scan");
  command->add_flag("--normals", arguments->properties.normals, "Include normals");
  command->add_flag("--intensities", arguments->properties.intensities, "Include signal-to-noise ratios");
  command->add_flag("--mixed", arguments->properties.mixed,
                    "Mark mixed points, which are the mean of several surfaces");
  command->add_flag("--json", arguments->json, "Print the summary as JSON");
  command->footer(
      "Example:\n  tanglebin scan dataset/A10/tube_configurations/1.txt --out cloud.ply --with-bin\n"
      "  tanglebin scan dataset/A10/tube_configurations/1.txt --out cloud.ply --scanner zivid-one-plus-l\n"
      "Formats: docs/formats.md. Scanners and their settings: docs/sensor.md.");
  command->callback([arguments] { scan_configuration(*arguments); });
}

}  // namespace tanglebin::cli
