#include <CLI/CLI.hpp>
#include <algorithm>
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
#include "tanglebin/cli/print.hpp"
#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/geometry/bin.hpp"
#include "tanglebin/io/configuration.hpp"
#include "tanglebin/io/images.hpp"
#include "tanglebin/io/pcd.hpp"
#include "tanglebin/io/ply.hpp"
#include "tanglebin/recipe/recipe.hpp"
#include "tanglebin/report/picture_of_scan.hpp"
#include "tanglebin/scan/scan_output.hpp"
#include "tanglebin/scan/scanner.hpp"

namespace tanglebin::cli {
namespace {

struct ScanArguments {
  std::string configuration;
  std::string out;
  std::string bin = "paper";
  std::string scanner = "paper";
  std::vector<std::string> settings;
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

// PLY, or an organized PCD if the file name ends in .pcd.
std::string cloud_bytes(const ScanArguments& arguments, const Scan& view, int tubes) {
  const CloudOf what = arguments.with_bin ? CloudOf::tubes_and_bin : CloudOf::tubes;
  std::ostringstream out;
  if (std::filesystem::path(arguments.out).extension() == ".pcd") {
    write_pcd(out, organized_cloud_from_scan(view, what, tubes, arguments.properties));
  } else {
    write_ply(out, cloud_from_scan(view, what, tubes, arguments.properties));
  }
  return std::move(out).str();
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
  print_out("{}: {} points on {} tubes, {} on the bin{}\n", arguments.out, tube_points, tubes.size(),
            points[bin_label], arguments.with_bin ? "" : " (left out)");
}

void scan_configuration(const ScanArguments& arguments) {
  const std::vector<Tube> tubes =
      read_input(arguments.configuration, [](auto&&... from) { return read_configuration(from...); });
  const Scanner scanner = scanner_with(arguments.scanner, arguments.settings, "--set");
  const Bin bin = bin_preset(arguments.bin);
  const Scan view =
      scan(tubes, bin, scanner.camera, scanner.sensor, parse_hexadecimal(arguments.seed, "--seed"));
  write_output(arguments.out, cloud_bytes(arguments, view, largest_id(tubes)));
  if (arguments.depth) {
    write_output(*arguments.depth, depth_png(depth_image(view)));
    write_output(std::filesystem::path(*arguments.depth).replace_extension(".json").string(),
                 camera_json(view.camera));
  }
  if (arguments.labels) write_output(*arguments.labels, label_png(label_image(view)));
  if (arguments.picture) {
    const Picture picture = picture_of_scan(scan(tubes, bin, scanner.camera), view, arguments.configuration);
    write_output(*arguments.picture, color_png(picture.width, picture.height, picture.pixels));
  }
  if (arguments.out != standard_stream) print_summary(arguments, view, tubes);
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
  command->add_option("--bin", arguments->bin, "Bin: paper or published")->capture_default_str();
  command
      ->add_option("--scanner", arguments->scanner,
                   "Scanner: paper (ideal), gaussian, zivid-one-plus-l or kinect-v1")
      ->capture_default_str();
  command
      ->add_option("--set", arguments->settings,
                   "Change a setting of the scanner, such as scanner.baseline=0.3")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command->add_option("--seed", arguments->seed, "Seed of the scanner's noise, hexadecimal as in a manifest")
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
