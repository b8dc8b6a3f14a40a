#include "tanglebin/model/axis/fragments/flat_surfaces.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "tanglebin/model/axis/fragments/neighbourhoods.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3f;

/// The neighbours of a point, within a reach (m).
struct Around {
  const Neighbourhood& neighbours;
  float reach;

  float square_metres(float square_reaches) const { return square_reaches * reach * reach; }
};

/// A place about which a surface is flat.
struct FlatPlace {
  Vector3f position;  // m
  Vector3f normal;    // unit, to either side
  float variance;     // of its points about the plane, m²
};

/// A plane through flat places.
class FlatSurface {
public:
  void add(const FlatPlace& place) {
    ++places_;
    const auto share = 1 / static_cast<float>(places_);
    position_ += share * (place.position - position_);
    variance_ += share * (place.variance - variance_);
    normals_ += normals_.dot(place.normal) < 0 ? Vector3f(-place.normal) : place.normal;
    normal_ = normals_.normalized();
    extent_.extend(place.position);
  }

  int places() const { return places_; }

  /// Whether a part of a surface, with its middle (m) and its normal, is in the plane.
  bool has_in_plane(const Vector3f& middle, const Vector3f& normal, float radius) const {
    constexpr float parallel_min = 0.8F;
    const float away_max = 0.05F * radius + 3 * std::sqrt(variance_);
    return std::abs((middle - position_).dot(normal_)) < away_max &&
           std::abs(normal.dot(normal_)) > parallel_min;
  }

  /// Whether a point (m) is between the places, or no farther away than this (m).
  bool is_near(const Vector3f& point, float distance) const {
    return extent_.squaredExteriorDistance(point) < distance * distance;
  }

private:
  int places_ = 0;
  Vector3f position_ = Vector3f::Zero();  // mean of the places, m
  float variance_ = 0;                    // mean of theirs, m²
  Vector3f normals_ = Vector3f::Zero();   // sum of theirs
  Vector3f normal_ = Vector3f::Zero();
  Eigen::AlignedBox3f extent_;
};

// Items half a radius apart in the image.
std::vector<std::size_t> spread_out(const PixelGrid& grid, double radius) {
  std::vector<std::size_t> items;
  PixelPosition last{0, -1};
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const int apart = std::max(1, static_cast<int>(grid.pixels_across(radius / 2, grid.point(i))));
    const PixelPosition& pixel = grid.pixels()[i];
    if (pixel.row % apart != 0 || (pixel.row == last.row && pixel.column < last.column + apart)) continue;
    items.push_back(i);
    last = pixel;
  }
  return items;
}

// The variance about a plane of what is seen of a tube, radii², if its variance across the tube is `breadth`:
// that of x² / 2r. It is 1/20 over all that can be seen from one side.
float bulge_of_tube(float breadth) {
  return std::min(breadth * breadth / 5, 0.05F);
}

// The noise of n points is known to √(2 / n). If it hides the bulge of a tube, the place may be one.
bool is_flat(const Around& near, const Around& wide, float radius) {
  constexpr float breadth_min = 0.1F;  // radii²
  constexpr float length_min = 0.35F;  // more than the flat end of a tube has, 1/4
  const float square_radius = radius * radius;
  const float breadth = wide.square_metres(wide.neighbours.breadth) / square_radius;
  const float length = wide.square_metres(wide.neighbours.length) / square_radius;
  if (!(breadth > breadth_min && length > length_min)) return false;
  const float noise = near.square_metres(near.neighbours.roughness) / square_radius;
  const float unsure = noise * std::sqrt(2 / static_cast<float>(wide.neighbours.count));
  const float bulge = wide.square_metres(wide.neighbours.roughness) / square_radius - noise;
  const float of_tube = bulge_of_tube(breadth);
  return of_tube > 5 * unsure && bulge < of_tube / 5 + 2 * unsure;
}

std::vector<FlatPlace> flat_places(const PixelGrid& grid, float reach, float radius) {
  const float wide_reach = 1.5F * radius;
  const std::vector<std::size_t> items = spread_out(grid, radius);
  std::vector<FlatPlace> places;
  for (std::size_t first = 0; first < items.size(); first += points_at_once) {
    const std::size_t number = std::min(points_at_once, items.size() - first);
    PointItems at_once{};
    at_once.fill(items[first]);
    std::copy_n(items.data() + first, number, at_once.data());
    const Neighbourhoods near = neighbourhoods_of(grid, at_once, reach);
    const Neighbourhoods wide = neighbourhoods_of(grid, at_once, wide_reach);
    for (std::size_t i = 0; i < number; ++i) {
      const Around around{wide[i], wide_reach};
      if (is_flat({near[i], reach}, around, radius))
        places.push_back({grid.point(at_once[i]) + wide[i].mean, wide[i].normal,
                          around.square_metres(std::max(wide[i].roughness, 0.0F))});
    }
  }
  return places;
}

// A scene has some ten. Of rubble, each stone may have its own; those that are found later do not count,
// since to compare all with each other would take minutes.
constexpr std::size_t surfaces_max = 1000;

std::vector<FlatSurface> flat_surfaces(const std::vector<FlatPlace>& places, float radius, int places_min) {
  std::vector<FlatSurface> surfaces;
  for (const FlatPlace& place : places) {
    const auto its_own = std::ranges::find_if(surfaces, [&](const FlatSurface& surface) {
      return surface.has_in_plane(place.position, place.normal, radius);
    });
    if (its_own != surfaces.end())
      its_own->add(place);
    else if (surfaces.size() < surfaces_max)
      surfaces.emplace_back().add(place);
  }
  std::erase_if(surfaces, [&](const FlatSurface& surface) { return surface.places() < places_min; });
  return surfaces;
}

}  // namespace

std::vector<bool> are_flat(const std::vector<std::optional<Patch>>& patches, const PixelGrid& grid,
                           const PatchSampling& sampling, double radius, int places_min) {
  const auto r = static_cast<float>(radius);
  const float distance = 5 * r;
  const std::vector<FlatSurface> surfaces =
      flat_surfaces(flat_places(grid, sampling.reach, r), r, places_min);
  std::vector<bool> flat(patches.size());
  for (std::size_t i = 0; i < patches.size(); ++i) {
    if (!patches[i]) continue;
    const Vector3f middle = grid.point(i * sampling.stride) + patches[i]->mean;
    flat[i] = std::ranges::any_of(surfaces, [&](const FlatSurface& surface) {
      return surface.has_in_plane(middle, patches[i]->normal, r) && surface.is_near(middle, distance);
    });
  }
  return flat;
}

}  // namespace tanglebin
