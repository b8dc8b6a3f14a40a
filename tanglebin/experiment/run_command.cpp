#include "tanglebin/experiment/run_command.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>

#include "tanglebin/base/error.hpp"
#include "tanglebin/experiment/given_cloud.hpp"
#include "tanglebin/files/safe_file.hpp"
#include "tanglebin/io/configuration.hpp"
#include "tanglebin/io/labels.hpp"
#include "tanglebin/io/pcd.hpp"
#include "tanglebin/io/ply.hpp"
#include "tanglebin/scene/write_scene.hpp"

namespace tanglebin {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// A new directory that is removed with this, whatever a command has done to it.
class PrivateDirectory {
public:
  explicit PrivateDirectory(const fs::path& parent) {
    std::string name = (fs::absolute(parent) / "command-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr)
      throw_refusal(parent, "cannot create a directory in it", last_error());
    path_ = name;
  }
  ~PrivateDirectory() {
    std::error_code error;
    fs::remove_all(path_, error);
    if (!error) return;
    std::error_code ignored;
    make_writable(path_, ignored);
    fs::remove_all(path_, ignored);
  }
  PrivateDirectory(const PrivateDirectory&) = delete;
  PrivateDirectory& operator=(const PrivateDirectory&) = delete;

  const fs::path& path() const { return path_; }

private:
  static void make_writable(const fs::path& directory, std::error_code& ignored) {
    fs::permissions(directory, fs::perms::owner_all, ignored);
    for (const fs::directory_entry& entry : fs::directory_iterator(directory, ignored)) {
      if (entry.is_directory(ignored) && !entry.is_symlink(ignored)) make_writable(entry.path(), ignored);
    }
  }

  fs::path path_;
};

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

template <typename Write>
void write_input(const fs::path& file, const Write& write) {
  std::ofstream out(file, std::ios::binary);
  write(out);
  if (!out.flush()) throw_refusal(file, "cannot write", last_error());
}

std::string in_braces(const Placeholder& placeholder) {
  return "{" + std::string(placeholder.name) + "}";
}

// Whether the command names the file.
bool asks_for(const Command& command, std::string_view file) {
  return std::ranges::any_of(placeholders(), [&](const Placeholder& placeholder) {
    return placeholder.file == file && std::ranges::any_of(command.words, [&](const std::string& word) {
             return word.find(in_braces(placeholder)) != std::string::npos;
           });
  });
}

void write_inputs(const Command& command, const PointCloud& cloud, const KnownScene& known,
                  const fs::path& directory) {
  if (asks_for(command, "cloud.ply"))
    write_input(directory / "cloud.ply", [&](std::ostream& out) { write_ply(out, cloud); });
  if (asks_for(command, "cloud.pcd"))
    write_input(directory / "cloud.pcd", [&](std::ostream& out) { write_pcd(out, cloud); });
  if (asks_for(command, "scene.toml"))
    write_input(directory / "scene.toml", [&](std::ostream& out) { write_scene(out, scene_of(known)); });
}

std::vector<std::string> filled_in(const Command& command, const fs::path& directory) {
  std::vector<std::string> words = command.words;
  for (std::string& word : words) {
    for (const Placeholder& placeholder : placeholders())
      replace_all(word, in_braces(placeholder), (directory / placeholder.file).string());
  }
  return words;
}

// That of this process, but with a working directory and a place for temporary files of its own.
std::vector<std::string> environment_in(const fs::path& directory) {
  std::vector<std::string> variables;
  for (char** variable = environ; *variable != nullptr; ++variable) {
    const std::string_view text = *variable;
    const bool is_replaced =
        text.starts_with("PWD=") || text.starts_with("OLDPWD=") || text.starts_with("TMPDIR=");
    if (!is_replaced) variables.emplace_back(text);
  }
  variables.push_back("PWD=" + directory.string());
  variables.push_back("TMPDIR=" + directory.string());
  return variables;
}

std::string how_it_ended(const ProcessResult& result, const ProcessLimits& limits) {
  switch (result.end) {
    case ProcessEnd::too_slow:
      return fmt::format("the command took longer than {:g} s",
                         std::chrono::duration<double>(limits.time).count());
    case ProcessEnd::too_large:
      return fmt::format("the command wrote more than {} bytes", limits.disk.value_or(0));
    case ProcessEnd::killed:
      return fmt::format("the command was ended by signal {} ({})", result.status, strsignal(result.status));
    case ProcessEnd::exited:
      break;
  }
  return fmt::format("the command ended with status {}", result.status);
}

// With what it said last.
[[noreturn]] void fail(const std::string& reason, const ProcessResult& result) {
  std::string_view said = result.err.empty() ? result.out : result.err;
  while (!said.empty() && said.back() == '\n') said.remove_suffix(1);
  throw InputError({}, said.empty() ? reason : fmt::format("{}: {}", reason, said));
}

// And not that of a system that lacks memory or the like, which may have it later.
bool is_its_own_fault(const std::error_code& error) {
  return error == std::errc::no_such_file_or_directory || error == std::errc::permission_denied ||
         error == std::errc::executable_format_error;
}

ProcessResult run(const Command& command, const fs::path& directory) {
  constexpr std::size_t most_to_keep = 4096;
  ProcessResult result = [&] {
    try {
      return run_process({.command = filled_in(command, directory),
                          .environment = environment_in(directory),
                          .directory = directory,
                          .limits = command.limits,
                          .output_max = most_to_keep});
    } catch (const std::system_error& error) {
      if (!is_its_own_fault(error.code())) throw;
      throw InputError({}, error.what());
    }
  }();
  for (std::string* text : {&result.out, &result.err}) {
    if (text->size() == most_to_keep) text->erase(0, text->find('\n') + 1);  // not half a line
    replace_all(*text, directory.string() + "/", "");
  }
  return result;
}

// The one of the outputs for labels that the command has written.
std::optional<fs::path> labels_in(const fs::path& directory) {
  for (const Placeholder& placeholder : placeholders()) {
    const bool is_for_labels = placeholder.file.starts_with("out.");
    std::error_code ignored;
    if (is_for_labels && fs::exists(directory / placeholder.file, ignored))
      return directory / placeholder.file;
  }
  return std::nullopt;
}

CommandOutput read_output(const fs::path& directory, const PointCloud& cloud) {
  CommandOutput output{};
  if (const std::optional<fs::path> file = labels_in(directory))
    output.labels = labels_of_points(cloud, read_labels(*file), file->string());
  if (fs::exists(directory / "tubes.txt")) {
    if (!fs::is_regular_file(directory / "tubes.txt"))
      throw InputError({"tubes.txt", 0, ""}, "something else", "a regular file");
    output.tubes = read_configuration(directory / "tubes.txt");
  }
  return output;
}

}  // namespace

CommandOutput run_command(const Command& command, const PointCloud& cloud, const KnownScene& known,
                          const fs::path& scratch) {
  const PrivateDirectory own(scratch);
  const fs::path& directory = own.path();
  write_inputs(command, cloud, known, directory);
  const Clock::time_point start = Clock::now();
  const ProcessResult result = run(command, directory);
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  if (result.end != ProcessEnd::exited || result.status != 0)
    fail(how_it_ended(result, command.limits), result);
  try {
    CommandOutput output = read_output(directory, cloud);
    if (!output.labels && !output.tubes)
      fail("the command wrote none of the files that it was asked for", result);
    output.seconds = seconds;
    return output;
  } catch (const InputError& error) {
    const InputPlace& place = error.place();
    const std::string file = place.file.empty() ? "" : fs::path(place.file).filename().string();
    throw InputError({file, place.line, place.field}, error.problem());
  }
}

}  // namespace tanglebin
