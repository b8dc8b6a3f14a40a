#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>

#include "tanglebin/scene/scene.hpp"

namespace tanglebin {

/// Reads a scene file (TOML, docs/formats.md). Unknown keys are errors. Camera files are relative to the
/// scene file's directory; of a stream, to `directory`. `image` is for a camera file with the cameras of
/// several images, if the scene file does not say which is meant. Throws InputError with file, line and key.
Scene read_scene(std::istream& in, const std::string& name, const std::filesystem::path& directory,
                 std::optional<int> image = {});
Scene read_scene(const std::filesystem::path& file, std::optional<int> image = {});

}  // namespace tanglebin
