#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cctype>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <system_error>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/text.hpp"
#include "tanglebin/cli/arguments.hpp"
#include "tanglebin/cli/checks.hpp"
#include "tanglebin/cli/commands.hpp"
#include "tanglebin/cli/outputs.hpp"
#include "tanglebin/cli/scene_options.hpp"
#include "tanglebin/io/configuration.hpp"
#include "tanglebin/io/images.hpp"
#include "tanglebin/io/read_cloud.hpp"
#include "tanglebin/report/picture.hpp"

namespace tanglebin::cli {
namespace {

constexpr const char* example = R"(Example:
  tanglebin preview dataset/A10/tube_configurations/1.txt --scene dataset --out pile.png
  tanglebin preview dataset/A10/plys/1.ply --azimuth-deg 30 --elevation-deg 60 --out cloud.png
Around a configuration, the bin of --scene is drawn.)";

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
  constexpr double degree = std::numbers::pi / 180;
  return {.azimuth = options.azimuth_deg * degree,
          .elevation = options.elevation_deg * degree,
          .width = options.width,
          .height = options.height};
}

Support support_of(const Options& options) {
  const Scene scene = options.scene ? scene_named(*options.scene, options.input) : Scene{};
  return scene.support.value_or(Support{.shape = Support::Shape::nothing});
}

/// Distinguishes configurations from clouds by the first character, which also works for pipes.
Picture draw(std::istream& in, const std::string& name, const Options& options) {
  const int first = in.peek();
  if (first == 'p' || first == '#' || first == 'V') {
    return picture_of_cloud(read_cloud(in, name), view_of(options), name);
  }
  if (first == std::istream::traits_type::eof() || std::isdigit(first) == 0) {
    const bool is_empty = first == std::istream::traits_type::eof();
    const char character = std::istream::traits_type::to_char_type(first);
    throw InputError({.file = name, .line = 0, .field = ""},
                     is_empty ? "an empty file" : excerpt({&character, 1}) + " at the start",
                     "a configuration, which begins with the number of tubes, or a PLY or PCD cloud");
  }
  return picture_of_tubes(read_configuration(in, name), support_of(options), view_of(options), name);
}

Picture draw_file(const std::string& file, const Options& options) {
  // Linux lets you open a directory for reading.
  if (std::filesystem::is_directory(file)) {
    throw InputError({.file = file, .line = 0, .field = ""}, "a directory", "a configuration or a cloud");
  }
  std::ifstream in(file, std::ios::binary);
  if (!in) {
    throw InputError({.file = file, .line = 0, .field = ""},
                     "cannot be opened: " + std::generic_category().message(errno));
  }
  return draw(in, file, options);
}

void run(const Options& options) {
  expect_outputs({{"--out", options.out, {".png"}}});
  const Picture picture =
      options.input == "-" ? draw(std::cin, "standard input", options) : draw_file(options.input, options);
  write_output(options.out, color_png(picture.width, picture.height, picture.pixels));
}

}  // namespace

void add_preview(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("preview", "Draw a tube configuration or a point cloud");
  command
      ->add_option("input", options->input,
                   "Configuration (.txt) or cloud (.ply, .pcd); - for standard input")
      ->required();
  command->add_option("--out", options->out, "Picture to write (.png); - for standard output")->required();
  command->add_option("--azimuth-deg", options->azimuth_deg, "Direction of the viewer, from +x towards +y")
      ->check(finite_number())
      ->capture_default_str();
  command
      ->add_option("--elevation-deg", options->elevation_deg,
                   "Elevation of the viewer above the horizontal, -90 to 90")
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
