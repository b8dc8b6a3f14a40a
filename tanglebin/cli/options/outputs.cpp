#include "tanglebin/cli/options/outputs.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/text.hpp"
#include "tanglebin/cli/options/arguments.hpp"
#include "tanglebin/dataset/dataset.hpp"
#include "tanglebin/dataset/manifest.hpp"
#include "tanglebin/files/read_file.hpp"

namespace tanglebin::cli {
namespace {

namespace fs = std::filesystem;

std::string extension_of(const std::string& file) {
  std::string extension = fs::path(file).extension().string();
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  std::ranges::transform(extension, extension.begin(), lower);
  return extension;
}

bool is_device_or_pipe(const std::string& file) {
  std::error_code error;
  return fs::is_other(fs::status(file, error));
}

// The same for every name of a file or a directory: "x.ply", "./x.ply".
std::string place_of(const std::string& file) {
  if (file == standard_stream) return file;
  std::error_code error;
  const fs::path place = fs::weakly_canonical(fs::absolute(file, error), error);
  return error ? file : place.string();
}

bool lists(const fs::path& manifest, const std::string& path) {
  const std::string entry = fmt::format(R"("path":"{}")", path);
  bool is_listed = false;
  for_each_line(manifest, [&](const FileLine& line) {
    is_listed = is_listed || line.text.find(entry) != std::string::npos;
  });
  return is_listed;
}

bool is_file_of_dataset(const fs::path& file, const fs::path& directory) {
  if (!fs::is_regular_file(directory / manifest_name)) return false;
  const std::string path = file.lexically_relative(directory).generic_string();
  return std::ranges::find(dataset_files, path) != dataset_files.end() ||
         lists(directory / manifest_name, path);
}

void expect_no_file_of_dataset(const std::string& option, const std::string& output) {
  const fs::path place = place_of(output);
  for (fs::path directory = place.parent_path(); directory.has_relative_path();
       directory = directory.parent_path()) {
    if (is_file_of_dataset(place, directory))
      throw InputError({"", 0, option}, excerpt(output) + ", which is a file of a dataset", "another name");
  }
}

}  // namespace

void expect_outputs(const std::vector<Output>& outputs, const std::vector<std::string>& inputs) {
  std::set<std::string> places;
  for (const auto& [option, file, extensions] : outputs) {
    if (!places.insert(place_of(file)).second)
      throw InputError({"", 0, option}, excerpt(file) + " twice", "different files");
    expect_no_input(option, file, inputs);
    if (file == standard_stream || is_device_or_pipe(file)) continue;
    if (std::ranges::find(extensions, extension_of(file)) == extensions.end())
      throw InputError({"", 0, option}, excerpt(file),
                       fmt::format("a name that ends in {}", fmt::join(extensions, " or ")));
    expect_no_file_of_dataset(option, file);
  }
}

void expect_no_input(const std::string& option, const std::string& output,
                     const std::vector<std::string>& inputs) {
  if (output == standard_stream || is_device_or_pipe(output)) return;
  const auto is_output = [&](const std::string& input) {
    return !input.empty() && place_of(input) == place_of(output);
  };
  if (std::ranges::any_of(inputs, is_output))
    throw InputError({"", 0, option}, excerpt(output) + ", which is also an input", "another name");
}

bool take_standard_output(const std::vector<Output>& outputs) {
  return std::ranges::find(outputs, standard_stream, &Output::file) != outputs.end();
}

bool is_pcd(const std::string& file) {
  return extension_of(file) == ".pcd";
}

}  // namespace tanglebin::cli
