#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "tanglebin/model/model_tubes.hpp"
#include "tanglebin/runs/process.hpp"

namespace tanglebin {

/// A program that labels one cloud, with the placeholders that run_command() fills in (docs/benchmark.md).
struct Command {
  std::string text;                ///< as it was given
  std::vector<std::string> words;  ///< the program and its arguments; those that name files by absolute path
  std::map<std::string, std::string> sha256{};  ///< of the program's file and of the others, by path
  ProcessLimits limits{};
};

/// Labels that exist already. "{ratio}" in the path stands for the downsampling ratio.
struct LabelsDirectory {
  std::string path;
};

/// A method that is built in, with settings of its own in place of the experiment's.
struct BuiltIn {
  Method method;
  std::string profile;  ///< the file that the settings are from
  ModelSettings model;  ///< with the experiment's seed
};

/// What models the clouds of an experiment, and its name in the results.
struct Entry {
  std::string name;
  std::variant<Method, BuiltIn, Command, LabelsDirectory> what;
};

/// Whether it is a method that is built in, with whatever settings.
bool is_built_in(const Entry& entry);

/// The methods that are built in.
Entry entry_of(Method method);
std::vector<Entry> built_in_entries();

/// What a Command may use up if nothing else is said: 600 s, and 1 GiB of disk.
ProcessLimits default_limits();

/// A command as on a shell's line: words between blanks, which quotes (' or ") and backslashes keep together;
/// nothing is expanded. Words that name files are looked for from `directory`, the program's in PATH. Throws
/// InputError if there is no such program, if a quote is open, or unless {cloud} and an output is asked for.
Command command_of(const std::string& text, const std::filesystem::path& directory,
                   const ProcessLimits& limits = default_limits());

/// Throws InputError if a name cannot be that of an entry, or two are the same. A name has letters, digits
/// and -_. and begins with a letter or digit; "axis" and "paper" are the methods that are built in.
void expect_names(const std::vector<Entry>& entries);

/// A placeholder of a command, without its braces, and the name of its file.
struct Placeholder {
  std::string_view name;
  std::string_view file;
};
const std::vector<Placeholder>& placeholders();

}  // namespace tanglebin
