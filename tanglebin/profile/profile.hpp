#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tanglebin/base/estimate.hpp"
#include "tanglebin/geometry/bin.hpp"
#include "tanglebin/model/model_tubes.hpp"
#include "tanglebin/model/scene/known_scene.hpp"

namespace tanglebin {

/// The latest format of profiles that read_profile() reads, and the one that write_profile() writes.
inline constexpr int profile_format = 1;

/// The tubes of a set, from the least to the greatest, m.
struct TubesMadeFor {
  double radius_min = 0;
  double radius_max = 0;
  double length_min = 0;  ///< of the centre line with all branches
  double length_max = 0;

  bool operator==(const TubesMadeFor&) const = default;
};

/// What a profile was calibrated for, and by what.
struct MadeFor {
  std::string scanner{};    ///< its preset; empty if it is none
  int image_width = 0;      ///< of the scanner's camera, pixels
  double focal_length = 0;  ///< the same
  Bin bin{};                ///< its inner size
  std::string recipe_sha256{};
  std::string version{};  ///< of Tanglebin
  std::string program_sha256{};
  std::vector<TubesMadeFor> tubes{};

  bool operator==(const MadeFor&) const = default;
};

/// What a calibration reached on scenes that it did not learn from: the mean of the objective over them, with
/// the default parameters and with the profile's, and the difference scene by scene.
struct Reached {
  std::string objective{};
  double ratio = 1;  ///< of the downsampling
  int scenes = 0;
  Estimate before{};
  Estimate after{};
  Estimate difference{};

  bool operator==(const Reached&) const = default;
};

/// Parameters of the methods, and where they are from if `tanglebin calibrate` found them.
struct Profile {
  std::map<std::string, double> parameters{};
  std::optional<Method> method{};  ///< that they are for
  std::optional<MadeFor> made_for{};
  std::optional<Reached> reached{};

  bool operator==(const Profile&) const = default;
};

/// Reads a profile (TOML, docs/formats.md). Throws InputError with file, line and key for what is not a
/// parameter or has an invalid value.
Profile read_profile(std::istream& in, const std::string& name);
Profile read_profile(const std::filesystem::path& file);

/// Sets the parameters that the profile names, and leaves the others.
void apply(const Profile& profile, ModelSettings& settings);

/// Throws InputError naming the profile's file if it is for none of these methods.
void expect_for(const Profile& profile, const std::vector<Method>& methods, const std::string& file);

/// Writes a profile, with the meaning of each parameter. `title` is a comment: what they were found from.
void write_profile(std::ostream& out, const Profile& profile, const std::string& title);

/// In which ways a scene is not what the profile was made for, by more than 2 %: the radius of its tubes,
/// their length, or the camera. A sentence each.
std::vector<std::string> doubts_of(const Profile& profile, const KnownScene& known);

}  // namespace tanglebin
