#include "tanglebin/model/axis/fragments/surface_patches.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "tanglebin/base/median.hpp"
#include "tanglebin/model/axis/fragments/neighbourhoods.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3f;

// Every so many items, from the first one on; in place of items that are none, the last one.
PointItems items_from(std::size_t first, std::size_t stride, std::size_t size) {
  PointItems items{};
  for (std::size_t i = 0; i < items.size(); ++i) items[i] = std::min(first + i * stride, size - 1);
  return items;
}

std::optional<Patch> patch_at(const PixelGrid& grid, std::size_t item, const Neighbourhood& around,
                              const PatchSettings& settings) {
  if (around.count < settings.neighbours_min || !(around.breadth >= settings.breadth_min))
    return std::nullopt;
  const Vector3f to_sensor = grid.camera().pose.translation().cast<float>() - grid.point(item);
  const bool is_turned_away = around.normal.dot(to_sensor) < 0;
  return Patch{around.mean, is_turned_away ? -around.normal : around.normal, around.roughness,
               around.breadth};
}

}  // namespace

PatchSampling suitable_sampling(const PixelGrid& grid, double radius, const PatchSettings& settings) {
  const auto most = static_cast<float>(settings.reach_max * radius);
  const auto least = static_cast<float>(settings.reach_min * radius);
  constexpr std::size_t looked_at = 500;
  const std::size_t stride = grid.size() / looked_at + 1;
  std::vector<float> counts;
  counts.reserve(looked_at);
  for (std::size_t first = 0; first < grid.size(); first += points_at_once * stride) {
    const Neighbourhoods found = neighbourhoods_of(grid, items_from(first, stride, grid.size()), most);
    for (std::size_t i = 0; i < found.size() && first + i * stride < grid.size(); ++i)
      counts.push_back(static_cast<float>(found[i].count));
  }
  if (counts.empty()) return {most, 1};
  const float wanted = most * std::sqrt(static_cast<float>(settings.neighbours) / median(std::move(counts)));
  // Not std::clamp(): the settings may have a least reach above the greatest, which then counts.
  const float reach = std::min(std::max(wanted, least), most);
  if (settings.at_every_point) return {reach, 1};
  const float surplus = reach / wanted * (reach / wanted);
  return {reach, std::max(static_cast<std::size_t>(surplus), std::size_t{1})};
}

std::vector<std::optional<Patch>> surface_patches(const PixelGrid& grid, const PatchSampling& sampling,
                                                  double radius, const PatchSettings& settings) {
  const auto [reach, stride] = sampling;
  std::vector<std::optional<Patch>> patches;
  patches.reserve(grid.size() / stride + 1);
  std::vector<float> roughness;
  roughness.reserve(grid.size() / stride + 1);
  Neighbourhoods found;
  for (std::size_t item = 0; item < grid.size(); item += stride) {
    const std::size_t place = patches.size() % found.size();
    if (place == 0) found = neighbourhoods_of(grid, items_from(item, stride, grid.size()), reach);
    patches.push_back(patch_at(grid, item, found[place], settings));
    if (patches.back()) roughness.push_back(patches.back()->roughness);
  }
  if (roughness.empty()) return patches;
  // Of a disc on a cylinder: the variance of x² / 2r.
  const auto share = reach / static_cast<float>(radius);
  const float of_a_tube = share * share / 64;
  const float most =
      static_cast<float>(settings.roughness_max) * std::max(of_a_tube, median(std::move(roughness)));
  for (std::optional<Patch>& patch : patches) {
    if (patch && patch->roughness > most) patch.reset();
  }
  return patches;
}

}  // namespace tanglebin
