#include <benchmark/benchmark.h>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "tanglebin/base/random.hpp"
#include "tanglebin/generate/generate.hpp"
#include "tanglebin/score/assign.hpp"
#include "tanglebin/score/score_clouds.hpp"
#include "tanglebin/score/score_tubes.hpp"
#include "tests/geometry/example_tubes.hpp"

namespace {

using namespace tanglebin;

/// Every tube overlaps every label, which is far denser than in a real cloud.
Confusion dense_confusion(int tubes, int segments) {
  Rng rng(5);
  Confusion confusion;
  for (int tube = 0; tube < tubes; ++tube) confusion.tubes.push_back({tube + 1, 0});
  for (int segment = 0; segment < segments; ++segment) confusion.segments.push_back({segment + 1, 0});
  for (std::size_t tube = 0; tube < confusion.tubes.size(); ++tube) {
    for (std::size_t segment = 0; segment < confusion.segments.size(); ++segment) {
      confusion.overlaps.push_back({tube, segment, uniform_integer(rng, 1, 10'000)});
    }
  }
  return confusion;
}

void assignment(benchmark::State& state) {
  const Confusion confusion =
      dense_confusion(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  for (auto _ : state) benchmark::DoNotOptimize(assign(confusion));
}
BENCHMARK(assignment)->Args({20, 40})->Args({200, 400})->Unit(benchmark::kMillisecond);

/// Points on 20 tubes, one after the other, roughly as a camera sees them.
PointCloud truth_cloud(std::size_t points) {
  Rng rng(6);
  PointCloud cloud;
  cloud.width = points;
  for (std::size_t i = 0; i < points; ++i) {
    const auto coordinate = [&] { return static_cast<float>(uniform_real(rng, -0.3, 0.3)); };
    const float x = coordinate();
    const float y = coordinate();
    cloud.points.emplace_back(x, y, coordinate());
    cloud.labels.push_back(static_cast<std::int32_t>(i * 20 / points) + 1);
  }
  return cloud;
}

/// The cloud's points in random order, a tenth with a wrong label, a tenth left out.
PointCloud labelled_cloud(PointCloud cloud) {
  Rng rng(7);
  for (std::size_t i = cloud.points.size(); i > 1; --i) {
    const auto j = static_cast<std::size_t>(uniform_integer(rng, 0, static_cast<int>(i) - 1));
    std::swap(cloud.points[i - 1], cloud.points[j]);
    std::swap(cloud.labels[i - 1], cloud.labels[j]);
  }
  cloud.width = cloud.points.size() * 9 / 10;
  cloud.points.resize(cloud.width);
  cloud.labels.resize(cloud.width);
  for (std::int32_t& label : cloud.labels) {
    if (uniform_real(rng, 0, 1) < 0.1) label = uniform_integer(rng, 1, 30);
  }
  return cloud;
}

void clouds(benchmark::State& state) {
  const PointCloud truth = truth_cloud(static_cast<std::size_t>(state.range(0)));
  const PointCloud labelled = labelled_cloud(truth);
  for (auto _ : state) benchmark::DoNotOptimize(score_clouds(truth, "truth", labelled, "labelled"));
}
BENCHMARK(clouds)->Arg(300'000)->Unit(benchmark::kMillisecond);

void labels(benchmark::State& state) {
  const PointCloud truth = truth_cloud(static_cast<std::size_t>(state.range(0)));
  Rng rng(8);
  std::vector<std::int32_t> predicted = truth.labels;
  for (std::int32_t& label : predicted) {
    if (uniform_real(rng, 0, 1) < 0.1) label = uniform_integer(rng, -1, 30);
  }
  for (auto _ : state) benchmark::DoNotOptimize(score(truth.labels, predicted));
}
BENCHMARK(labels)->Arg(300'000)->Unit(benchmark::kMillisecond);

/// Chains of 0.5 m, as densely packed as in a bin.
std::vector<Tube> true_tubes(int count) {
  Rng rng(9);
  std::vector<Tube> tubes;
  for (int id = 1; id <= count; ++id) {
    tubes.push_back(draw_tube(rng, test::chain_spec(30), id));
    const double x = uniform_real(rng, -0.25, 0.25);
    const double y = uniform_real(rng, -0.15, 0.15);
    transform(tubes.back(), Eigen::Isometry3d(Eigen::Translation3d(x, y, 0)));
  }
  return tubes;
}

/// The same chains with each edge cut into ten, slightly displaced.
std::vector<Tube> modelled_tubes(const std::vector<Tube>& truth) {
  Rng rng(10);
  const auto off = [&] { return uniform_real(rng, -0.002, 0.002); };
  std::vector<Tube> modelled;
  for (const Tube& tube : truth) {
    std::vector<Eigen::Vector3d> points;
    for (const Capsule& edge : capsules(tube)) {
      for (int part = 0; part < 10; ++part) {
        const double x = off();
        const double y = off();
        points.emplace_back(edge.a + part / 10.0 * (edge.b - edge.a) + Eigen::Vector3d(x, y, off()));
      }
    }
    modelled.push_back(test::tube_through(points));
  }
  return modelled;
}

void tubes(benchmark::State& state) {
  const std::vector<Tube> truth = true_tubes(static_cast<int>(state.range(0)));
  const std::vector<Tube> modelled = modelled_tubes(truth);
  for (auto _ : state) benchmark::DoNotOptimize(score_tubes(truth, modelled));
}
BENCHMARK(tubes)->Arg(40)->Unit(benchmark::kMillisecond);

}  // namespace
