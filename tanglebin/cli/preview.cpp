#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "tanglebin/base/constants.hpp"
#include "tanglebin/cli/commands.hpp"
#include "tanglebin/cli/options/arguments.hpp"
#include "tanglebin/cli/options/checks.hpp"
#include "tanglebin/cli/options/cloud_or_tubes.hpp"
#include "tanglebin/cli/options/outputs.hpp"
#include "tanglebin/cli/options/scene_options.hpp"
#include "tanglebin/io/images.hpp"
#include "tanglebin/pictures/picture.hpp"

namespace tanglebin::cli {
namespace {

constexpr const char* example = R"(Example:
  tanglebin preview dataset/A10/tube_configurations/1.txt --scene dataset --out pile.png
  tanglebin preview dataset/A10/plys/1.ply --azimuth-deg 30 --elevation-deg 60 --out cloud.png
Around tubes, the bin of --scene is drawn; without --scene, none.)";

struct Options {
  std::string input;
  std::string out;
  std::optional<std::string> scene;
  double azimuth_deg = -60;
  double elevation_deg = 45;
  int width = 1200;
  int height = 900;
};

View view_of(const Options& options) {
  return {.azimuth = options.azimuth_deg * degree,
          .elevation = options.elevation_deg * degree,
          .width = options.width,
          .height = options.height};
}

Picture draw(const CloudOrTubes& input, const Options& options) {
  if (const auto* cloud = std::get_if<PointCloud>(&input))
    return picture_of_cloud(*cloud, view_of(options), options.input);
  return picture_of_tubes(std::get<std::vector<Tube>>(input), support_in(options.scene, options.input),
                          view_of(options), options.input);
}

void run(const Options& options) {
  expect_outputs({{"--out", options.out, {".png"}}}, inputs_with(options.scene, {options.input}));
  const Picture picture = draw(read_cloud_or_tubes(options.input), options);
  write_output(options.out, color_png(picture.width, picture.height, picture.pixels));
}

}  // namespace

void add_preview(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("preview", "Draw a tube configuration or a point cloud");
  command
      ->add_option("input", options->input,
                   "Tubes (configuration or tubes.json) or cloud (.ply, .pcd); - for standard input")
      ->required();
  command->add_option("--out", options->out, "Picture to write (.png); - for standard output")->required();
  command
      ->add_option("--azimuth-deg", options->azimuth_deg,
                   "Where the viewer is, in degrees: 0 towards +x, 90 towards +y")
      ->check(finite_number())
      ->capture_default_str();
  command
      ->add_option("--elevation-deg", options->elevation_deg,
                   "How high the viewer is, in degrees: 0 at the side, 90 straight above")
      ->check(finite_number())
      ->capture_default_str();
  command->add_option("--width", options->width, "Width of the picture, pixels")
      ->check(whole_number(1, largest_picture))
      ->capture_default_str();
  command->add_option("--height", options->height, "Height of the picture, pixels")
      ->check(whole_number(1, largest_picture))
      ->capture_default_str();
  add_scene_option(*command, options->scene);
  command->footer(example);
  command->callback([options] { run(*options); });
}

}  // namespace tanglebin::cli
