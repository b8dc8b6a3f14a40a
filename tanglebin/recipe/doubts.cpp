#include "tanglebin/recipe/doubts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "tanglebin/geometry/view_of_bin.hpp"
#include "tanglebin/io/images.hpp"

namespace tanglebin {
namespace {

constexpr double fewest_pixels = 4;
// Long tubes that lie at random fill about 5.4 diameters per length of the space (Philipse, Langmuir 12,
// 1996): for the paper's tubes a quarter.
constexpr double most_filled = 1.0 / 3;

using Doubts = std::vector<std::string>;

bool is_in_view(const Camera& camera, const Eigen::Vector3d& point) {
  return pixel_of(camera, point).has_value();
}

bool is_rim_in_view(const Camera& camera, const Bin& bin) {
  for (const double x : {-bin.length / 2, bin.length / 2})
    for (const double y : {-bin.width / 2, bin.width / 2})
      if (!is_in_view(camera, {x, y, bin.height})) return false;
  return true;
}

// A case's own tubes if they differ, or the kinds of the set.
const std::vector<TubeSpec>& tubes_of(const SetRecipe& set) {
  return set.each_tube.empty() ? set.kinds : set.each_tube;
}

double thinnest_radius(const SetRecipe& set) {
  return std::ranges::min(tubes_of(set), {}, &TubeSpec::radius).radius;
}

void doubt_pixels(const Recipe& recipe, const Camera& camera, const std::string& where, Doubts& found) {
  const double depth = depth_of(camera, Eigen::Vector3d::Zero());
  for (const SetRecipe& set : recipe.sets) {
    const double pixels = std::min(camera.fx, camera.fy) * 2 * thinnest_radius(set) / depth;
    if (pixels < fewest_pixels)
      found.push_back(fmt::format("{}: a tube of set {} on the floor is only {:.2g} pixels across", where,
                                  set.name, pixels));
  }
}

void doubt_camera(const Recipe& recipe, const Camera& camera, const std::string& where, Doubts& found) {
  const double height = camera.pose.translation().z();
  if (height <= 0) {
    found.push_back(fmt::format("{}: the camera is {:.6g} m below the bin's floor", where, -height));
    return;
  }
  if (!is_rim_in_view(camera, recipe.bin))
    found.push_back(fmt::format("{}: part of the bin's rim is out of the camera's view", where));
  if (depth_of(camera, Eigen::Vector3d::Zero()) > 0) doubt_pixels(recipe, camera, where, found);
  const double farthest = depths_of(camera, recipe.bin).farthest;
  if (recipe.output.depths && farthest > deepest)
    found.push_back(
        fmt::format("{}: the bin is up to {:.4g} m from the camera; depth images have no more than {} m",
                    where, farthest, deepest));
}

// Bends and ends hardly count.
double volume(const TubeSpec& spec) {
  double length = 0;
  for (const Segment& segment : segments_of(spec)) length += segment.length;
  return std::numbers::pi * spec.radius * spec.radius * length;
}

void doubt_room(const Recipe& recipe, const SetRecipe& set, Doubts& found) {
  const Bin& bin = recipe.bin;
  const int tubes = std::ranges::max(numbers_of_tubes(set));
  const std::vector<TubeSpec>& specs = tubes_of(set);
  const auto thickest = std::ranges::max_element(specs, {}, &TubeSpec::radius);
  if (bin.height < 2 * thickest->radius) return;  // tubes lie on a plate, not in it
  double sum = 0;
  for (const TubeSpec& spec : specs) sum += volume(spec);
  const double each = sum / static_cast<double>(specs.size());
  const double filled = tubes * each / (bin.length * bin.width * bin.height);
  if (filled > most_filled)
    found.push_back(
        fmt::format("set {}: {} tubes have {:.0f} % of the bin's volume; a heap fills up to about {:.0f} %",
                    set.name, tubes, 100 * filled, 100 * most_filled));
}

// A mass in grams, or a radius that is too small.
void doubt_mass(const SetRecipe& set, Doubts& found) {
  constexpr double densest = 22600;  // kg/m³, osmium
  for (const TubeSpec& spec : tubes_of(set)) {
    const double density = spec.density > 0 ? spec.density : spec.mass / volume(spec);
    if (density <= densest) continue;
    found.push_back(fmt::format("set {}: a tube has {:.3g} kg/m³, more than the densest metal, {:.3g} kg/m³",
                                set.name, density, densest));
    return;
  }
}

}  // namespace

std::vector<std::string> doubts(const Recipe& recipe) {
  Doubts found;
  for (const Scanner& scanner : scanners(recipe)) {
    const std::string where = scanner.name.empty() ? "scanner" : fmt::format("scanner {}", scanner.name);
    doubt_camera(recipe, scanner.camera, where, found);
  }
  for (const SetRecipe& set : recipe.sets) {
    doubt_room(recipe, set, found);
    doubt_mass(set, found);
  }
  return found;
}

}  // namespace tanglebin
