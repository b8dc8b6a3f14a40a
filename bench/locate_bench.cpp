// How well locate() finds a bin, and how long it takes. Each row is many scenes of one to twenty tubes, moved
// at random with their camera. corner_mm and angle_deg are the largest errors of any scene that was located,
// *_p50 the medians; refused is how many were not. error_over_sd is the RMS, over scenes and axes, of error
// over standard deviation: 1 if the latter is honest. The rows `plane` have a table instead of a bin, the
// rows `no-table` only the tubes: there, all should be refused. The rows `recall` compare the micro-recall of
// 20 tubes with the true bin and with the one that was located.

#include <benchmark/benchmark.h>
#include <fmt/core.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <tuple>
#include <vector>

#include "bench/not_a_box.hpp"
#include "bench/paper_sets.hpp"
#include "bench/row.hpp"
#include "tanglebin/base/constants.hpp"
#include "tanglebin/base/counter_random.hpp"
#include "tanglebin/base/error.hpp"
#include "tanglebin/base/picked.hpp"
#include "tanglebin/model/locate/locate.hpp"
#include "tanglebin/model/model_tubes.hpp"
#include "tanglebin/scan/scan_output.hpp"
#include "tanglebin/scan/scanner.hpp"
#include "tanglebin/score/score.hpp"
#include "tanglebin/simulate/simulate.hpp"

namespace tanglebin {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

/// What the tubes lie in, or on; `table`: one as large as the image; `unseen`: one of which there is no
/// point.
enum class Base { bin, table, unseen };

/// A kind of scenes: what differs from the paper's set A.
struct Scenes {
  std::uint64_t seed;
  std::string scanner;
  bool other_cells = false;  ///< bins, distances and angles drawn at random
  bool not_a_box = false;    ///< sizes a little wrong, walls that lean, a table around
  Base base = Base::bin;
};

/// A scan, and what is known of it.
struct Given {
  PointCloud cloud;
  Support support;  ///< with the true pose
  Camera camera;
};

void look_at_bin(Camera& camera, double distance, double tilt, double azimuth, double height) {
  const Vector3d target(0, 0, height / 2);
  const Vector3d back(std::sin(tilt) * std::cos(azimuth), std::sin(tilt) * std::sin(azimuth), std::cos(tilt));
  Eigen::Matrix3d rotation;
  const Vector3d x = Vector3d(0, 0, 1).cross(back).norm() > 1e-6
                         ? Vector3d(Vector3d(0, 0, 1).cross(back).normalized())
                         : Vector3d(Vector3d::UnitX());
  rotation << x, -back.cross(x), -back;
  camera.pose.linear() = rotation;
  camera.pose.translation() = target + distance * back;
}

// The smallest distance at which the bin is in the image from above.
double smallest_distance(const Camera& camera, const Bin& bin) {
  const double along_x = (bin.length + 2 * bin.wall) * camera.fx / camera.width;
  const double along_y = (bin.width + 2 * bin.wall) * camera.fy / camera.height;
  constexpr double spare = 1.1;
  return spare * std::max(along_x, along_y) + bin.height;
}

void draw_cell(Recipe& recipe, const CounterRandom& random) {
  std::uint64_t number = 0;
  const auto draw = [&](double low, double high) { return low + (high - low) * random.uniform(number++); };
  recipe.bin.length = draw(0.3, 1.2);
  recipe.bin.width = recipe.bin.length * draw(0.5, 1);
  recipe.bin.height = draw(0.1, 0.3);
  recipe.bin.wall = draw(0.004, 0.03);
  recipe.sets[0].kinds[0].segments[0].length = std::min(0.5, 0.9 * recipe.bin.length);
  const double nearest = std::max(0.6, smallest_distance(recipe.camera, recipe.bin));
  const double distance = draw(nearest, std::max(nearest * 1.3, 2.5));
  look_at_bin(recipe.camera, distance, draw(0, 45 * degree), draw(0, 2 * std::numbers::pi),
              recipe.bin.height);
  recipe.sensor.working_distance = distance;
}

// Puts a table under the bin wherever the camera saw nothing because there is nothing.
void add_table(PointCloud& cloud, const Recipe& recipe, const std::vector<Tube>& tubes, double noise,
               const CounterRandom& random) {
  const Scan ideal = scan(tubes, recipe.bin, recipe.camera);
  const double height = -recipe.bin.wall;
  for (int v = 0; v < recipe.camera.height; ++v) {
    for (int u = 0; u < recipe.camera.width; ++u) {
      const PixelWindow& window = ideal.window;
      const bool in_window = u >= window.left && v >= window.top && u < window.left + window.width &&
                             v < window.top + window.height;
      if (in_window && std::isfinite(ideal.at(u, v).range)) continue;
      const Ray ray = ray_through(recipe.camera, u, v);
      if (ray.direction.z() > -0.1) continue;
      const double distance = (height - ray.origin.z()) / ray.direction.z();
      const auto pixel = static_cast<std::uint64_t>(v * recipe.camera.width + u);
      cloud.points.emplace_back(
          (ray.origin + (distance + noise * random.normal(pixel)) * ray.direction).cast<float>());
    }
  }
}

Isometry3d random_motion(const CounterRandom& random) {
  const auto draw = [&](std::uint64_t number, double most) {
    return most * (2 * random.uniform(number) - 1);
  };
  const Eigen::Quaterniond turn =
      Eigen::Quaterniond(random.normal(100), random.normal(101), random.normal(102), random.normal(103))
          .normalized();
  return Eigen::Translation3d(draw(104, 2), draw(105, 2), draw(106, 2)) * turn;
}

void move(Given& given, const Isometry3d& motion) {
  for (Eigen::Vector3f& point : given.cloud.points) point = (motion * point.cast<double>()).cast<float>();
  given.camera.pose = motion * given.camera.pose;
  given.support.pose = motion;
}

// The walls are taken away, and the floor has no end.
PointCloud cloud_on_table(const SimulatedScene& scene, const Recipe& recipe, Base base) {
  const Bin table{.length = 20, .width = 20, .height = 1e-6};
  return cloud_from_scan(scan(scene.tubes, table, recipe.camera, recipe.sensor, scene.seed),
                         base == Base::unseen ? CloudOf::tubes : CloudOf::tubes_and_bin,
                         static_cast<int>(scene.tubes.size()));
}

Given scene_of(const Scenes& scenes, int number) {
  const CounterRandom random(scenes.seed, static_cast<std::uint64_t>(number));
  Recipe recipe = paper_set("A", 30);
  recipe.seed = scenes.seed;
  recipe.camera = camera_preset(scenes.scanner);
  recipe.sensor = sensor_preset(scenes.scanner);
  if (scenes.scanner == "kinect-v1") look_at_bin(recipe.camera, 1.0, 0, 0, 0.2);
  if (scenes.other_cells) draw_cell(recipe, random);
  Given given;
  if (scenes.not_a_box) recipe.bin.wall = std::max(recipe.bin.wall, 0.01);
  given.support.bin = recipe.bin;
  if (scenes.not_a_box) {
    given.support.margin = 0.005;
    recipe.bin.length += 0.002;
    recipe.bin.width -= 0.002;
    recipe.bin.height += 0.002;
  }
  const int tubes = 1 + (number - 1) % 20;
  const auto scene = simulate(recipe, {"A", tubes, number});
  given.cloud = scenes.base == Base::bin ? cloud_from_scan(scene.scan, CloudOf::tubes_and_bin, tubes)
                                         : cloud_on_table(scene, recipe, scenes.base);
  if (scenes.base != Base::bin) given.support.shape = Support::Shape::plane;
  given.camera = recipe.camera;
  if (scenes.not_a_box) {
    lean(given.cloud, recipe.bin);
    add_table(given.cloud, recipe, scene.tubes, 0.0004, random);
  }
  move(given, random_motion(random));
  return given;
}

/// How far a located bin is from the true one.
struct Errors {
  double corner;   // m, of the corner that is farthest off
  double angle;    // rad
  double squares;  // of errors over standard deviations, the mean of all axes that are found
};

// Of a plane, some axes are chosen, not found.
double squares_over_sd(const Vector3d& error, const Vector3d& sd) {
  double squares = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (sd[axis] > 0) squares += error[axis] / sd[axis] * error[axis] / sd[axis];
  }
  return squares;
}

Errors errors_of(const Located& located, const Given& given) {
  const Isometry3d off = given.support.pose.inverse() * located.support.pose;
  Errors errors{0, Eigen::AngleAxisd(off.linear()).angle(), 0};
  const Bin& bin = given.support.bin;
  for (const double x : {-bin.length / 2, bin.length / 2}) {
    for (const double y : {-bin.width / 2, bin.width / 2}) {
      for (const double z : {0.0, bin.height}) {
        const Vector3d corner(x, y, z);
        errors.corner = std::max(errors.corner, (off * corner - corner).norm());
      }
    }
  }
  const Vector3d rotation = Eigen::AngleAxisd(off.linear()).angle() * Eigen::AngleAxisd(off.linear()).axis();
  errors.squares = (squares_over_sd(off.translation(), located.position_sd) +
                    squares_over_sd(rotation, located.rotation_sd)) /
                   static_cast<double>((located.position_sd.array() > 0).count() +
                                       (located.rotation_sd.array() > 0).count());
  return errors;
}

double median_of(std::vector<double> values) {
  if (values.empty()) return 0;
  std::ranges::sort(values);
  return values[values.size() / 2];
}

void locate_scenes(benchmark::State& state, const Scenes& scenes, int count) {
  std::vector<double> corners;
  std::vector<double> angles;
  double squares = 0;
  int refused = 0;
  double seconds = 0;
  for ([[maybe_unused]] const auto iteration : state) {
    for (int number = 1; number <= count; ++number) {
      const Given given = scene_of(scenes, number);
      const auto begin = std::chrono::steady_clock::now();
      try {
        const Located located = locate(given.cloud, given.support, given.camera);
        seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        const Errors errors = errors_of(located, given);
        corners.push_back(1e3 * errors.corner);
        angles.push_back(errors.angle / degree);
        squares += errors.squares;
      } catch (const InputError& error) {
        ++refused;
        fmt::print("scene {}: {}\n", number, error.what());
      }
    }
  }
  const auto located = static_cast<double>(corners.size());
  state.counters["scenes"] = count;
  state.counters["refused"] = refused;
  state.counters["corner_mm"] = corners.empty() ? 0 : *std::ranges::max_element(corners);
  state.counters["corner_mm_p50"] = median_of(corners);
  state.counters["angle_deg"] = angles.empty() ? 0 : *std::ranges::max_element(angles);
  state.counters["angle_deg_p50"] = median_of(angles);
  state.counters["error_over_sd"] = located > 0 ? std::sqrt(squares / located) : 0;
  state.counters["ms"] = located > 0 ? 1e3 * seconds / located : 0;
}

// Micro-recall over the points that the filter keeps around the true bin.
double micro_recall(const Given& given, const Support& support) {
  const Model truth_filter = model_tubes(given.cloud, {.support = given.support, .camera = given.camera});
  const Model model = model_tubes(given.cloud, {.support = support, .camera = given.camera});
  return score(picked(given.cloud.labels, truth_filter.filtered), picked(model.labels, truth_filter.filtered))
      .micro_recall;
}

void model_scenes(benchmark::State& state, const Scenes& scenes, int count) {
  double given_recall = 0;
  double located_recall = 0;
  double worst = 0;
  for ([[maybe_unused]] const auto iteration : state) {
    for (int i = 1; i <= count; ++i) {
      const Given given = scene_of(scenes, 20 * i);  // 20 tubes
      const double with_given = micro_recall(given, given.support);
      const double with_located =
          micro_recall(given, locate(given.cloud, given.support, given.camera).support);
      given_recall += with_given / count;
      located_recall += with_located / count;
      worst = std::max(worst, with_given - with_located);
    }
  }
  state.counters["scenes"] = count;
  state.counters["recall_given"] = given_recall;
  state.counters["recall_located"] = located_recall;
  state.counters["largest_loss"] = worst;
}

// The settings of locate() were chosen on the scenes with seeds 7 and 8; those with seeds 2024 and 2025 are
// reported.
const bool registered = [] {
  for (const auto& [name, seed, some, many] :
       {std::tuple{"tuning", std::uint64_t{7}, 20, 40}, std::tuple{"report", std::uint64_t{2024}, 50, 100}}) {
    const std::string prefix = std::string(name) + "/";
    const auto add = [&prefix](const std::string& row, const Scenes& scenes, int count) {
      add_row(prefix + row, locate_scenes, scenes, count);
    };
    add("zivid-one-plus-l", {seed, "zivid-one-plus-l"}, many);
    add("kinect-v1", {seed, "kinect-v1"}, many);
    add("paper", {seed, "paper"}, some);
    add("other-cells", {seed, "zivid-one-plus-l", true}, some);
    add("not-a-box", {seed + 1, "zivid-one-plus-l", false, true}, some);
    add("other-cells-not-a-box", {seed + 1, "zivid-one-plus-l", true, true}, some);
    for (const std::string scanner : {"paper", "zivid-one-plus-l", "kinect-v1", "phoxi"}) {
      add("plane/" + scanner, {seed, scanner, true, false, Base::table}, some);
      add("no-table/" + scanner, {seed, scanner, true, false, Base::unseen}, some);
    }
  }
  for (const std::string scanner : {"paper", "zivid-one-plus-l"})
    add_row("recall/" + scanner, model_scenes, Scenes{2024, scanner}, 10);
  return true;
}();

}  // namespace
}  // namespace tanglebin
