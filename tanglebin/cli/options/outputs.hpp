#pragma once

#include <string>
#include <string_view>
#include <vector>

// The files that a command writes.
namespace tanglebin::cli {

/// A file to write. Its name's extension says the format.
struct Output {
  std::string option;                        ///< that names it
  std::string file;                          ///< "-" for standard output
  std::vector<std::string_view> extensions;  ///< that it may have, lower case: ".ply"
};

/// Throws InputError naming the option if a file has none of its extensions, in upper or lower case, or if
/// two outputs are the same, one is an input, or one is a file that a dataset lists. Standard output, devices
/// and pipes need no extension.
void expect_outputs(const std::vector<Output>& outputs, const std::vector<std::string>& inputs);

/// Throws InputError naming the option if its file or directory is one of the inputs, by whatever name. An
/// input that is not given is empty. Standard streams, devices and pipes may be both.
void expect_no_input(const std::string& option, const std::string& output,
                     const std::vector<std::string>& inputs);

/// Whether one of them is standard output, which then has room for nothing else.
bool take_standard_output(const std::vector<Output>& outputs);

/// The extensions of clouds.
inline const std::vector<std::string_view> cloud_extensions{".ply", ".pcd"};

/// Whether to write a cloud as PCD: by the extension. PLY is for all else.
bool is_pcd(const std::string& file);

}  // namespace tanglebin::cli
