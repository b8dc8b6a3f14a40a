#pragma once

#include <cstdint>

#include "tanglebin/report/scene_view.hpp"

// A scene to look at in a browser, and how to.
namespace tanglebin::test {

inline constexpr std::int32_t strip_length = 300;  ///< points along each tube
inline constexpr std::int32_t strip_width = 40;    ///< and across

inline Tube straight_tube(int id, double y) {
  return {.id = id,
          .radius = 0.02,
          .nodes = {{.id = 1, .position = {0, y, 0}}, {.id = 2, .position = {0.3, y, 0}}},
          .edges = {{.from = 0, .to = 1, .order = 1}}};
}

/// Two straight tubes side by side, each as a strip of points, and a strip of the bin. A method calls tube 1
/// "7", gives the left half of tube 2 to it too, and leaves out the right half of tube 2.
inline ViewedScene two_tubes() {
  ViewedScene scene{
      .name = "two tubes",
      .cloud = {},
      .truth =
          Labelling{.name = "truth", .labels = {}, .tubes = {straight_tube(1, 0), straight_tube(2, 0.1)}},
      .found = {{.name = "method", .labels = {}, .tubes = {straight_tube(7, 0)}}},
      .support = {.shape = Support::Shape::nothing}};
  for (const std::int32_t label : {1, 2, 0}) {
    for (int i = 0; i < strip_length; ++i) {
      for (int j = 0; j < strip_width; ++j) {
        const double y = (label + 2) % 3 * 0.1 + 0.001 * (j - strip_width / 2);
        scene.cloud.points.emplace_back(0.001F * static_cast<float>(i), static_cast<float>(y), 0.02F);
        scene.truth->labels.push_back(label);
        const bool is_left = i < strip_length / 2;
        scene.found.front().labels.push_back(label == 1 ? 7 : label == 2 ? (is_left ? 7 : -1) : 0);
      }
    }
  }
  scene.cloud.width = scene.cloud.points.size();
  return scene;
}

/// A script's function: the pixels of a canvas, and how many of them have a colour. By hue, because the
/// shading makes them darker.
inline constexpr const char* painted_on = R"js(
const paintedOn = canvas => {
  const pixels = () => {
    const copy = Object.assign(document.createElement("canvas"), { width: canvas.width, height: canvas.height });
    const context = copy.getContext("2d");
    context.drawImage(canvas, 0, 0);
    return context.getImageData(0, 0, copy.width, copy.height).data;
  };
  const count = color => {
    const data = pixels();
    const wanted = [1, 3, 5].map(at => parseInt(color.slice(at, at + 2), 16));
    const most = Math.max(...wanted);
    let result = 0;
    for (let i = 0; i < data.length; i += 4) {
      const bright = Math.max(data[i], data[i + 1], data[i + 2]);
      if (data[i + 3] < 250 || bright < 60) continue;
      if (wanted.every((value, k) => Math.abs(value / most - data[i + k] / bright) < 0.06)) ++result;
    }
    return result;
  };
  return { pixels, count };
};
)js";

}  // namespace tanglebin::test
