#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "tanglebin/base/bytes_of.hpp"
#include "tanglebin/base/constants.hpp"
#include "tanglebin/base/error.hpp"
#include "tanglebin/cli/commands.hpp"
#include "tanglebin/cli/options/arguments.hpp"
#include "tanglebin/cli/options/outputs.hpp"
#include "tanglebin/cli/options/scene_options.hpp"
#include "tanglebin/cli/terminal/print.hpp"
#include "tanglebin/scene/locate_support.hpp"
#include "tanglebin/scene/read_measurement.hpp"
#include "tanglebin/scene/write_scene.hpp"

namespace tanglebin::cli {
namespace {

constexpr double millimetre = 0.001;

struct LocateArguments {
  std::string cloud;
  std::optional<std::string> out;
  SceneOptions scene;
  bool json = false;
};

nlohmann::ordered_json rows_of(const Eigen::Isometry3d& pose) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (int row = 0; row < 4; ++row) {
    rows.push_back(
        {pose.matrix()(row, 0), pose.matrix()(row, 1), pose.matrix()(row, 2), pose.matrix()(row, 3)});
  }
  return rows;
}

// A plane leaves its x, its y and its turn about z open: these have no standard deviation.
bool is_determined(const Located& located, bool is_position, int axis) {
  return located.support.shape == Support::Shape::bin || is_position == (axis == 2);
}

nlohmann::ordered_json json_of_sd(const Located& located, bool is_position, const Eigen::Vector3d& sd) {
  nlohmann::ordered_json values = nlohmann::ordered_json::array();
  for (int axis = 0; axis < 3; ++axis) {
    if (is_determined(located, is_position, axis)) {
      values.push_back(sd[axis]);
    } else {
      values.push_back(nullptr);
    }
  }
  return values;
}

std::string text_of_sd(const Located& located, bool is_position, const Eigen::Vector3d& sd, int digits) {
  std::string text;
  for (int axis = 0; axis < 3; ++axis) {
    const std::string value =
        is_determined(located, is_position, axis) ? fmt::format("{:.{}f}", sd[axis], digits) : "-";
    text += fmt::format(" {:>9}", value);
  }
  return text;
}

void print_json(const LocatedScene& found) {
  const Located& located = found.located;
  nlohmann::ordered_json json{{"shape", name_of(located.support.shape)},
                              {"support_to_world", rows_of(located.support.pose)},
                              {"position_sd_mm", json_of_sd(located, true, located.position_sd / millimetre)},
                              {"rotation_sd_deg", json_of_sd(located, false, located.rotation_sd / degree)},
                              {"residual_mm", located.residual / millimetre},
                              {"explained", located.explained},
                              {"contradicted", located.contradicted}};
  if (located.support.shape == Support::Shape::bin) {
    json["measured"] = {{"length", located.measured.length},
                        {"width", located.measured.width},
                        {"height", located.measured.height},
                        {"wall", nullptr}};
    if (located.is_wall_measured) json["measured"]["wall"] = located.measured.wall;
  }
  for (const LocatedPart& part : located.parts)
    json["parts"].push_back(
        {{"name", part.name}, {"points", part.points}, {"noise_mm", part.noise / millimetre}});
  json["notes"] = found.notes;
  for (const std::string& doubt : found.doubts) json["notes"].push_back(doubt);
  print_json_line(json);
}

void print_table(const Located& located, bool wall_is_given) {
  const Eigen::Vector3d position = located.support.pose.translation();
  const Eigen::Quaterniond rotation(located.support.pose.linear());
  print_out("position   {:>9.4f} {:>9.4f} {:>9.4f} m\n", position.x(), position.y(), position.z());
  print_out("  ±       {} mm along the support's x, y, z\n",
            text_of_sd(located, true, located.position_sd / millimetre, 2));
  print_out("quaternion {:>9.5f} {:>9.5f} {:>9.5f} {:>9.5f} (w x y z)\n", rotation.w(), rotation.x(),
            rotation.y(), rotation.z());
  print_out("  ±       {} degrees about the support's x, y, z\n",
            text_of_sd(located, false, located.rotation_sd / degree, 3));
  print_out("residual   {:>9.2f} mm\n", located.residual / millimetre);
  print_out("points     {:>9.1f} % on the support, {:.1f} % behind it\n", 100 * located.explained,
            100 * located.contradicted);
  if (located.support.shape == Support::Shape::bin) {
    const Bin& measured = located.measured;
    const Bin& given = located.support.bin;
    print_out("sizes      {:.4f} x {:.4f} x {:.4f} m{}; given {} x {} x {} m{}\n", measured.length,
              measured.width, measured.height,
              located.is_wall_measured ? fmt::format(", wall {:.4f} m", measured.wall) : "", given.length,
              given.width, given.height, wall_is_given ? fmt::format(", wall {} m", given.wall) : "");
  }
  for (const LocatedPart& part : located.parts)
    print_out("{:<24} {:>6} points  {:.2f} mm\n", part.name, part.points, part.noise / millimetre);
}

std::vector<Output> outputs(const LocateArguments& arguments) {
  if (!arguments.out) return {};
  return {{"--out", *arguments.out, {".toml"}}};
}

void locate_in_cloud(const LocateArguments& arguments) {
  expect_outputs(outputs(arguments),
                 inputs_with(arguments.scene.scene, {arguments.cloud, arguments.scene.camera.value_or("")}));
  const Scene told = scene_of(arguments.scene, arguments.cloud);
  const Measurement measured =
      read_input(arguments.cloud, [&](auto&&... from) { return read_measurement(from..., told); });
  const LocatedScene found =
      with_file(arguments.cloud, [&] { return locate_support(measured.scene, measured.cloud); });
  print_notes(found.notes);
  print_notes(found.doubts);
  if (arguments.out) {
    write_output(*arguments.out, bytes_of([&](std::ostream& out) { write_scene(out, found.scene); }));
  }
  if (take_standard_output(outputs(arguments))) return;
  if (arguments.json) {
    print_json(found);
  } else {
    print_table(found.located, told.wall_is_given);
  }
}

}  // namespace

void add_locate(CLI::App& app) {
  const auto arguments = std::make_shared<LocateArguments>();
  CLI::App* command = app.add_subcommand("locate", "Find the bin or plane of a scene in a cloud");
  command->add_option("cloud", arguments->cloud, "Cloud (PLY or PCD) or depth image; - for standard input")
      ->required();
  command->add_option("--out", arguments->out,
                      "Write the scene with the pose found: .toml (docs/formats.md); - for standard output");
  add_scene_option(*command, arguments->scene.scene);
  add_camera_options(*command, arguments->scene);
  command->add_flag("--json", arguments->json, "Print the pose as JSON");
  command->footer(
      "Example:\n  tanglebin locate scan.ply --scene scene.toml --out located.toml\n"
      "  tanglebin model scan.ply --scene located.toml --out labelled.ply\n"
      "The scene's [support] has the shape, and the sizes of a bin; its pose is only a guess. Where the bin "
      "is not found surely,\nthe program says what it saw and exits with 2 (docs/real-scans.md).");
  command->callback([arguments] { locate_in_cloud(*arguments); });
}

}  // namespace tanglebin::cli
