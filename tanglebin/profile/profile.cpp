#include "tanglebin/profile/profile.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <ostream>
#include <string_view>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/text.hpp"
#include "tanglebin/files/read_file.hpp"
#include "tanglebin/files/toml_table.hpp"
#include "tanglebin/model/parameters.hpp"

namespace tanglebin {
namespace {

// What a profile has besides parameters.
constexpr std::string_view format_key = "format";
constexpr std::string_view method_key = "method";
constexpr std::string_view made_for_key = "made_for";
constexpr std::string_view reached_key = "reached";
constexpr std::array own_keys = {format_key, method_key, made_for_key, reached_key};

bool is_parameter(const std::string& path) {
  return std::ranges::find(own_keys, path) == own_keys.end();
}

void expect_format(const TomlTable& root) {
  root.require({format_key});
  int format = 0;
  root.get(format_key, format);
  if (format != profile_format)
    root.fail(format_key, fmt::format("{}", format), fmt::format("{}", profile_format));
}

// ---- Reading

double read_parameter(const TomlSource& source, const std::string& name, const toml::node& node) {
  const std::optional<double> value = node.is_number() ? node.value<double>() : std::nullopt;
  if (!value) throw InputError({source.file(), source.line(name), name}, description(node), "a number");
  ModelSettings any;
  with_place({source.file(), source.line(name)}, [&] { set_parameter(any, name, *value); });
  return *value;
}

std::optional<Method> read_method(const TomlTable& root) {
  if (!root.has(method_key)) return std::nullopt;
  std::string name;
  root.get(method_key, name);
  return with_place({root.file(), root.line(method_key)}, [&] { return method_named(name); });
}

void get_positive(const TomlTable& table, std::string_view key, auto& value) {
  table.require({key});
  table.get(key, value);
  if (!(value > 0)) table.fail(key, fmt::format("{}", value), "a number above 0");
}

void get_text(const TomlTable& table, std::string_view key, std::string& value) {
  table.require({key});
  table.get(key, value);
  const bool is_plain = std::ranges::all_of(value, [](char character) {
    return character >= ' ' && character <= '~' && character != '"' && character != '\\';
  });
  if (!is_plain) table.fail(key, excerpt(value), "text without quotes, backslashes and special characters");
}

TubesMadeFor read_tubes_made_for(const TomlTable& table) {
  TubesMadeFor tubes;
  table.allow({"radius_min", "radius_max", "length_min", "length_max"});
  get_positive(table, "radius_min", tubes.radius_min);
  get_positive(table, "radius_max", tubes.radius_max);
  get_positive(table, "length_min", tubes.length_min);
  get_positive(table, "length_max", tubes.length_max);
  return tubes;
}

Bin read_bin_made_for(const TomlTable& table) {
  Bin bin;
  table.allow({"length", "width", "height"});
  get_positive(table, "length", bin.length);
  get_positive(table, "width", bin.width);
  get_positive(table, "height", bin.height);
  return bin;
}

MadeFor read_made_for(const TomlTable& table) {
  MadeFor made_for;
  table.allow({"scanner", "image_width", "focal_length", "bin", "recipe_sha256", "version", "program_sha256",
               "tube"});
  get_text(table, "scanner", made_for.scanner);
  get_positive(table, "image_width", made_for.image_width);
  get_positive(table, "focal_length", made_for.focal_length);
  made_for.bin = read_bin_made_for(table.table("bin"));
  get_text(table, "recipe_sha256", made_for.recipe_sha256);
  get_text(table, "version", made_for.version);
  get_text(table, "program_sha256", made_for.program_sha256);
  for (const TomlTable& tubes : table.tables("tube")) made_for.tubes.push_back(read_tubes_made_for(tubes));
  return made_for;
}

Estimate read_estimate(const TomlTable& table) {
  Estimate estimate;
  table.allow({"mean", "low", "high"});
  table.require({"mean", "low", "high"});
  table.get("mean", estimate.mean);
  table.get("low", estimate.low);
  table.get("high", estimate.high);
  return estimate;
}

Reached read_reached(const TomlTable& table) {
  Reached reached;
  table.allow({"objective", "ratio", "scenes", "before", "after", "difference"});
  get_text(table, "objective", reached.objective);
  get_positive(table, "ratio", reached.ratio);
  get_positive(table, "scenes", reached.scenes);
  reached.before = read_estimate(table.table("before"));
  reached.after = read_estimate(table.table("after"));
  reached.difference = read_estimate(table.table("difference"));
  return reached;
}

// ---- Writing

void write_parameters(std::ostream& out, const std::map<std::string, double>& parameters) {
  for (const Parameter& parameter : declared_parameters()) {
    const auto found = parameters.find(parameter.name);
    if (found == parameters.end()) continue;
    out << fmt::format("{} = {}  # {} [{}]\n", parameter.name, real_text(found->second), parameter.meaning,
                       parameter.standard);
  }
}

void write_made_for(std::ostream& out, const MadeFor& made_for) {
  out << fmt::format(
      "\n[made_for]\nscanner = \"{}\"\nimage_width = {}  # pixels\nfocal_length = {}  # pixels\n",
      made_for.scanner, made_for.image_width, real_text(made_for.focal_length));
  const Bin& bin = made_for.bin;
  out << fmt::format("bin = {{ length = {}, width = {}, height = {} }}  # m\n", real_text(bin.length),
                     real_text(bin.width), real_text(bin.height));
  out << fmt::format("recipe_sha256 = \"{}\"\nversion = \"{}\"\nprogram_sha256 = \"{}\"\n",
                     made_for.recipe_sha256, made_for.version, made_for.program_sha256);
  for (const TubesMadeFor& tubes : made_for.tubes) {
    out << fmt::format(
        "\n[[made_for.tube]]  # m\nradius_min = {}\nradius_max = {}\nlength_min = {}\nlength_max = {}\n",
        real_text(tubes.radius_min), real_text(tubes.radius_max), real_text(tubes.length_min),
        real_text(tubes.length_max));
  }
}

std::string estimate_text(const Estimate& estimate) {
  return fmt::format("{{ mean = {}, low = {}, high = {} }}", real_text(estimate.mean),
                     real_text(estimate.low), real_text(estimate.high));
}

void write_reached(std::ostream& out, const Reached& reached) {
  out << "\n[reached]  # on scenes that it was not calibrated on, with 95 % intervals\n";
  out << fmt::format("objective = \"{}\"\nratio = {}\nscenes = {}\n", reached.objective,
                     real_text(reached.ratio), reached.scenes);
  out << fmt::format("before = {}\nafter = {}\ndifference = {}\n", estimate_text(reached.before),
                     estimate_text(reached.after), estimate_text(reached.difference));
}

// ---- Doubts

constexpr double tolerance = 0.02;

bool is_within(double value, double least, double greatest) {
  return value >= least * (1 - tolerance) && value <= greatest * (1 + tolerance);
}

// "0.5 m", "0.5 to 0.6 m", "0.008 or 0.0125 m".
std::string ranges_text(const std::vector<TubesMadeFor>& tubes, double TubesMadeFor::*least,
                        double TubesMadeFor::*greatest) {
  std::vector<std::string> texts;
  for (const TubesMadeFor& its : tubes) {
    std::string text = its.*least == its.*greatest
                           ? fmt::format("{:.4g}", its.*least)
                           : fmt::format("{:.4g} to {:.4g}", its.*least, its.*greatest);
    if (std::ranges::find(texts, text) == texts.end()) texts.push_back(std::move(text));
  }
  return fmt::format("{} m", fmt::join(texts, " or "));
}

bool is_radius_of(const TubesMadeFor& tubes, const TubeKind& kind) {
  return is_within(kind.radius, tubes.radius_min, tubes.radius_max);
}

bool is_length_of(const TubesMadeFor& tubes, const TubeKind& kind) {
  return !kind.length_is_known() || is_within(kind.length(), tubes.length_min, tubes.length_max);
}

std::optional<std::string> doubt_of(const std::vector<TubesMadeFor>& tubes, const TubeKind& kind) {
  const auto its_radius = [&](const TubesMadeFor& its) { return is_radius_of(its, kind); };
  const auto its_size = [&](const TubesMadeFor& its) { return its_radius(its) && is_length_of(its, kind); };
  if (std::ranges::none_of(tubes, its_radius)) {
    return fmt::format("made for tubes with a radius of {}, not {:.4g} m",
                       ranges_text(tubes, &TubesMadeFor::radius_min, &TubesMadeFor::radius_max), kind.radius);
  }
  if (std::ranges::none_of(tubes, its_size)) {
    return fmt::format("made for tubes with a length of {}, not {:.4g} m",
                       ranges_text(tubes, &TubesMadeFor::length_min, &TubesMadeFor::length_max),
                       kind.length());
  }
  return std::nullopt;
}

std::optional<std::string> doubt_of(const MadeFor& made_for, const Camera& camera) {
  if (made_for.image_width == camera.width &&
      is_within(camera.fx, made_for.focal_length, made_for.focal_length))
    return std::nullopt;
  return fmt::format(
      "made for {} with images {} pixels wide and a focal length of {:.5g} pixels, not {} pixels wide and "
      "{:.5g}",
      made_for.scanner.empty() ? "a camera" : made_for.scanner, made_for.image_width, made_for.focal_length,
      camera.width, camera.fx);
}

}  // namespace

Profile read_profile(std::istream& in, const std::string& name) {
  const toml::table tree = parse_toml(read_bytes(in, name), name);
  const TomlSource source(name, tree);
  const TomlTable root(source, tree, "");
  expect_format(root);
  Profile profile{.method = read_method(root)};
  if (root.has(made_for_key)) profile.made_for = read_made_for(root.table(made_for_key));
  if (root.has(reached_key)) profile.reached = read_reached(root.table(reached_key));
  for_each_node(tree, "", [&](const std::string& path, const toml::node& node) {
    if (!is_parameter(path)) return false;
    if (!node.is_table()) profile.parameters.emplace(path, read_parameter(source, path, node));
    return node.is_table();
  });
  return profile;
}

Profile read_profile(const std::filesystem::path& file) {
  std::optional<std::ifstream> in = open_if_there(file);
  if (!in) throw InputError({file.string(), 0, ""}, "cannot be opened: there is no such file");
  return read_profile(*in, file.string());
}

void apply(const Profile& profile, ModelSettings& settings) {
  for (const auto& [name, value] : profile.parameters) set_parameter(settings, name, value);
}

void expect_for(const Profile& profile, const std::vector<Method>& methods, const std::string& file) {
  if (!profile.method || methods.empty() || std::ranges::find(methods, *profile.method) != methods.end())
    return;
  std::vector<std::string> names(methods.size());
  std::ranges::transform(methods, names.begin(), [](Method method) { return name_of(method); });
  throw InputError({file, 0, std::string(method_key)}, name_of(*profile.method),
                   fmt::format("a profile for {}", fmt::join(names, " or ")));
}

void write_profile(std::ostream& out, const Profile& profile, const std::string& title) {
  out << fmt::format("# {}\n\n{} = {}\n", printable(title), format_key, profile_format);
  if (profile.method) out << fmt::format("{} = \"{}\"\n", method_key, name_of(*profile.method));
  if (!profile.parameters.empty()) out << '\n';
  write_parameters(out, profile.parameters);
  if (profile.made_for) write_made_for(out, *profile.made_for);
  if (profile.reached) write_reached(out, *profile.reached);
}

std::vector<std::string> doubts_of(const Profile& profile, const KnownScene& known) {
  std::vector<std::string> doubts;
  if (!profile.made_for) return doubts;
  for (const TubeKind& kind : known.kinds) {
    if (const auto doubt = doubt_of(profile.made_for->tubes, kind)) doubts.push_back(*doubt);
  }
  if (const auto doubt = doubt_of(*profile.made_for, known.camera)) doubts.push_back(*doubt);
  return doubts;
}

}  // namespace tanglebin
