#pragma once

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "tanglebin/cloud/cloud.hpp"

namespace tanglebin {

inline bool same_float(float a, float b) {
  return a == b || (std::isnan(a) && std::isnan(b));
}

inline bool same_point(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  return same_float(a.x(), b.x()) && same_float(a.y(), b.y()) && same_float(a.z(), b.z());
}

inline bool same_points(const PointCloud& a, const PointCloud& b) {
  return std::ranges::equal(a.points, b.points, same_point);
}

inline bool same_properties(const PointCloud& a, const PointCloud& b) {
  return same_points(a, b) && a.labels == b.labels && a.colors == b.colors;
}

/// Two points with what a sensor adds.
inline PointCloud cloud_of_a_sensor() {
  PointCloud cloud;
  cloud.points = {{1, 2, 3}, {4, 5, 6}};
  cloud.width = 2;
  cloud.normals = {{0, 0, 1}, {0, -1, 0}};
  cloud.labels = {1, 0};
  cloud.intensities = {0.5F, 2.25F};
  cloud.mixed = {0, 1};
  return cloud;
}

inline void expect_same_sensor_properties(const PointCloud& a, const PointCloud& b) {
  EXPECT_EQ(a.normals, b.normals);
  EXPECT_EQ(a.labels, b.labels);
  EXPECT_EQ(a.intensities, b.intensities);
  EXPECT_EQ(a.mixed, b.mixed);
}

/// Two points with everything.
inline PointCloud small_cloud() {
  PointCloud cloud;
  cloud.points = {{0.25F, -0.5F, 0.125F}, {1.5F, 2.0F, -3.0F}};
  cloud.labels = {0, 2};
  cloud.colors = {Color{128, 128, 128}, Color{1, 2, 255}};
  cloud.width = 2;
  return cloud;
}

/// Any finite float, denormal and huge ones too.
inline rc::Gen<float> any_finite_float() {
  return rc::gen::map(rc::gen::arbitrary<std::uint32_t>(), [](std::uint32_t bits) {
    const auto value = std::bit_cast<float>(bits);
    return std::isfinite(value) ? value : 0.0F;
  });
}

/// An unorganized cloud of 1 to 40 points with or without labels and colours.
inline rc::Gen<PointCloud> any_cloud() {
  return rc::gen::exec([] {
    PointCloud cloud;
    cloud.width = *rc::gen::inRange<std::size_t>(1, 41);
    const bool labels = *rc::gen::arbitrary<bool>();
    const bool colors = *rc::gen::arbitrary<bool>();
    for (std::size_t i = 0; i < cloud.width; ++i) {
      cloud.points.emplace_back(*any_finite_float(), *any_finite_float(), *any_finite_float());
      if (labels) cloud.labels.push_back(*rc::gen::inRange(-1, 30));
      if (colors) cloud.colors.push_back(*rc::gen::arbitrary<Color>());
    }
    return cloud;
  });
}

/// The bytes of a number in the given order.
template <class T>
std::string bytes_of(T value, std::endian order = std::endian::little) {
  auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if (order != std::endian::native) std::ranges::reverse(bytes);
  return {bytes.begin(), bytes.end()};
}

}  // namespace tanglebin
