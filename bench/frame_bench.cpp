// A whole organized frame of 1944 x 1200 pixels, such as a Zivid's: twenty tubes in the paper's bin, some
// 400,000 points on them, and the table all around. Reading the file and modelling its tubes, on one core, by
// format. read_ms and model_ms are parts of the time, other counters the steps of modelling; peak_MB is the
// most memory that the process had, peak_less_MB without what it had before.

#include <benchmark/benchmark.h>
#include <fmt/core.h>
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <sstream>
#include <string>

#include "bench/paper_sets.hpp"
#include "tanglebin/io/depth_input.hpp"
#include "tanglebin/io/images.hpp"
#include "tanglebin/io/pcd.hpp"
#include "tanglebin/io/ply.hpp"
#include "tanglebin/io/read_cloud.hpp"
#include "tanglebin/model/model_tubes.hpp"
#include "tanglebin/scan/scan_output.hpp"
#include "tanglebin/scan/scanner.hpp"
#include "tanglebin/score/score.hpp"
#include "tanglebin/simulate/simulate.hpp"

namespace tanglebin {
namespace {

namespace fs = std::filesystem;

constexpr int tubes = 20;

Recipe recipe_of_frame() {
  Recipe recipe = paper_set("A", 30);
  recipe.camera = downward_camera(1944, 1200, 2730, {0, 0, 1.7});
  recipe.sensor = sensor_preset("zivid-one-plus-l");
  return recipe;
}

// What is not of the bin is a table on which it stands.
void add_table(PointCloud& cloud, const Recipe& recipe) {
  const Bin& bin = recipe.bin;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (cloud.points[i].allFinite() || i % 50 == 0) continue;
    const Ray ray = ray_through(recipe.camera, static_cast<double>(i % cloud.width),
                                static_cast<double>(i / cloud.width));
    const double distance = (-bin.wall - ray.origin.z()) / ray.direction.z();
    const Eigen::Vector3d point = ray.origin + distance * ray.direction;
    const bool is_under_bin =
        std::abs(point.x()) < bin.length / 2 + bin.wall && std::abs(point.y()) < bin.width / 2 + bin.wall;
    if (!is_under_bin) cloud.points[i] = point.cast<float>();
  }
}

DepthImage depths_of(const PointCloud& cloud, const Camera& camera) {
  DepthImage image{camera.width, camera.height, {}};
  for (const Eigen::Vector3f& point : cloud.points)
    image.depths.push_back(static_cast<float>(depth_of(camera, point.cast<double>())));
  return image;
}

std::string binary_pcd(const PointCloud& cloud) {
  std::string file = fmt::format(
      "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH {}\nHEIGHT {}\nDATA binary\n",
      cloud.width, cloud.height);
  file.append(reinterpret_cast<const char*>(cloud.points.data()), 12 * cloud.points.size());
  return file;
}

std::string npy(const DepthImage& image) {
  const std::string header = fmt::format("{{'descr': '<f4', 'fortran_order': False, 'shape': ({}, {}), }}\n",
                                         image.height, image.width);
  std::string file = "\x93NUMPY" + std::string("\x01\x00", 2);
  file += {static_cast<char>(header.size()), '\0'};
  return file + header +
         std::string(reinterpret_cast<const char*>(image.depths.data()), 4 * image.depths.size());
}

template <typename Write>
std::string bytes_of(const Write& write, const PointCloud& cloud) {
  std::ostringstream out;
  write(out, cloud);
  return std::move(out).str();
}

/// The frame's files and what is known of it.
struct Frame {
  KnownScene known;
  std::vector<std::int32_t> truth;
  fs::path directory = fs::temp_directory_path() / fmt::format("tanglebin-frame-{}", ::getpid());

  Frame() {
    const Recipe recipe = recipe_of_frame();
    known = {.support = {.bin = recipe.bin}, .camera = recipe.camera};
    PointCloud cloud =
        organized_cloud_from_scan(simulate(recipe, {"A", tubes, 1}).scan, CloudOf::tubes_and_bin, tubes);
    truth = cloud.labels;
    add_table(cloud, recipe);
    const DepthImage depths = depths_of(cloud, recipe.camera);
    fs::create_directory(directory);
    write("binary_compressed.pcd",
          bytes_of([](auto& out, const auto& what) { write_pcd(out, what); }, cloud));
    write("binary.ply", bytes_of([](auto& out, const auto& what) { write_ply(out, what); }, cloud));
    write("binary.pcd", binary_pcd(cloud));
    write("depth.png", depth_png(depths));
    write("depth.npy", npy(depths));
  }
  ~Frame() { fs::remove_all(directory); }
  Frame(const Frame&) = delete;
  Frame& operator=(const Frame&) = delete;

  void write(const std::string& name, const std::string& bytes) const {
    std::ofstream(directory / name, std::ios::binary) << bytes;
  }
};

// A depth image is in the camera's frame.
KnownScene in_camera_frame(KnownScene known) {
  known.support.pose = known.camera.pose.inverse(Eigen::Isometry);
  known.camera.pose.setIdentity();
  return known;
}

// The process's resident memory, MB: "VmRSS" now, "VmHWM" the most since reset_peak().
double memory(const std::string& key) {
  std::ifstream status("/proc/self/status");
  std::string line;
  while (std::getline(status, line)) {
    if (line.starts_with(key)) return std::stod(line.substr(key.size() + 1)) / 1024;
  }
  return 0;
}

void reset_peak() {
  std::ofstream("/proc/self/clear_refs") << 5;
}

using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

void ReadAndModel(benchmark::State& state, const std::string& name) {
  static const Frame frame;
  const fs::path file = frame.directory / name;
  const bool is_image = name.starts_with("depth");
  const KnownScene known = is_image ? in_camera_frame(frame.known) : frame.known;
  const double before = memory("VmRSS");
  reset_peak();
  for ([[maybe_unused]] const auto iteration : state) {
    const Clock::time_point start = Clock::now();
    const PointCloud cloud = is_image ? read_depth_image(file, intrinsics_of(known.camera),
                                                         name.ends_with("png") ? depth_scale : 1)
                                      : read_cloud(file);
    state.counters["read_ms"] = milliseconds_since(start);
    const Clock::time_point read = Clock::now();
    const Model model = model_tubes(cloud, known);
    state.counters["model_ms"] = milliseconds_since(read);
    for (const Step& step : model.steps) state.counters[step.name + "_ms"] = 1e3 * step.seconds;
    state.PauseTiming();
    const Score result = score(frame.truth, model.labels);
    state.counters["points"] = static_cast<double>(result.points);
    state.counters["micro_recall"] = result.micro_recall;
    state.ResumeTiming();
  }
  state.counters["peak_MB"] = memory("VmHWM");
  state.counters["peak_less_MB"] = memory("VmHWM") - before;
}

BENCHMARK_CAPTURE(ReadAndModel, pcd_binary, "binary.pcd")->Iterations(3)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(ReadAndModel, pcd_binary_compressed, "binary_compressed.pcd")
    ->Iterations(3)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(ReadAndModel, ply_binary, "binary.ply")->Iterations(3)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(ReadAndModel, depth_png, "depth.png")->Iterations(3)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(ReadAndModel, depth_npy, "depth.npy")->Iterations(3)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace tanglebin
