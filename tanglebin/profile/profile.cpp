#include "tanglebin/profile/profile.hpp"

#include <fmt/format.h>

#include <fstream>
#include <ostream>

#include "tanglebin/base/error.hpp"
#include "tanglebin/io/read_file.hpp"
#include "tanglebin/io/toml_table.hpp"
#include "tanglebin/model/parameters.hpp"

namespace tanglebin {
namespace {

constexpr std::string_view format_key = "format";

void expect_format(const TomlTable& root) {
  root.require({format_key});
  int format = 0;
  root.get(format_key, format);
  if (format != profile_format)
    root.fail(format_key, fmt::format("{}", format), fmt::format("{}", profile_format));
}

void read_parameter(const TomlSource& source, const std::string& name, const toml::node& node,
                    ModelSettings& settings) {
  const std::optional<double> value = node.is_number() ? node.value<double>() : std::nullopt;
  if (!value) throw InputError({source.file(), source.line(name), name}, description(node), "a number");
  with_place(source.file(), source.line(name), [&] { set_parameter(settings, name, *value); });
}

}  // namespace

void read_profile(std::istream& in, const std::string& name, ModelSettings& settings) {
  const toml::table tree = parse_toml(read_bytes(in, name), name);
  const TomlSource source(name, tree);
  expect_format({source, tree, ""});
  for_each_node(tree, "", [&](const std::string& path, const toml::node& node) {
    if (!node.is_table() && path != format_key) read_parameter(source, path, node, settings);
    return node.is_table();
  });
}

void read_profile(const std::filesystem::path& file, ModelSettings& settings) {
  std::optional<std::ifstream> in = open_if_there(file);
  if (!in) throw InputError({file.string(), 0, ""}, "cannot be opened: there is no such file");
  read_profile(*in, file.string(), settings);
}

void write_profile(std::ostream& out, const std::map<std::string, double>& parameters,
                   const std::string& made_from) {
  out << fmt::format("# {}\n\n{} = {}\n\n", made_from, format_key, profile_format);
  for (const auto& [name, value] : parameters) out << fmt::format("{} = {}\n", name, real_text(value));
}

}  // namespace tanglebin
