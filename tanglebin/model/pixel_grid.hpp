#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tanglebin/scan/camera.hpp"

namespace tanglebin {

/// Points sorted by the pixels of the camera that saw them: what is beside a point on a surface is around its
/// pixel, whatever the order and density of the cloud.
class PixelGrid {
public:
  /// Points in metres, world frame. Those that do not project into the image are left out.
  PixelGrid(const std::vector<Eigen::Vector3f>& points, const Camera& camera);

  struct Item {
    Eigen::Vector3f point;  ///< m
    std::uint32_t index;    ///< into the points that the grid was made of
  };

  struct Pixel {
    int column;
    int row;
  };

  /// The points, pixel after pixel and row after row, and the pixel of each.
  const std::vector<Item>& items() const { return items_; }
  const std::vector<Pixel>& pixels() const { return pixels_; }

  /// The items in columns first … last of a row; columns and rows may be beyond the image.
  std::span<const Item> run(int row, int first, int last) const;

  /// How many pixels wide a length (m) appears at a point.
  double pixels_across(double length, const Eigen::Vector3f& point) const;

private:
  std::size_t position_of(const Pixel& pixel) const;

  Camera camera_;
  int left_ = 0;  // the part of the image that has points
  int top_ = 0;
  int width_ = 0;
  int height_ = 0;
  std::vector<Item> items_;
  std::vector<Pixel> pixels_;
  std::vector<std::uint32_t> starts_;  // where each pixel's items begin; at last the number of items
};

}  // namespace tanglebin
