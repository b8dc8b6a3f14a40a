#include <benchmark/benchmark.h>
#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "bench/pile.hpp"
#include "tanglebin/scan/scanner.hpp"

namespace {

using namespace tanglebin;

/// tanglebin::scan() as users call it, from building the index to the last pixel.
void exact_scan(benchmark::State& state, const char* camera_name) {
  const Bin bin;
  const auto tubes = pile(static_cast<int>(state.range(0)), bin);
  const Camera camera = camera_preset(camera_name);
  std::size_t pixels = 0;
  for (auto _ : state) {
    const Scan result = scan(tubes, bin, camera);
    pixels = result.pixels.size();
    benchmark::DoNotOptimize(result.pixels.data());
  }
  state.counters["pixels"] = static_cast<double>(pixels);
}

/// The reference: the same pixels with Embree in single precision only. Tubes are chains with neighbours, the
/// bin is made of triangles; keeps distance and primitive.
class PlainScene {
public:
  PlainScene(const std::vector<Tube>& tubes, const Bin& bin) {
    add_tubes(tubes);
    add_boxes(boxes(bin));
    rtcCommitScene(scene_);
  }
  ~PlainScene() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  PlainScene(const PlainScene&) = delete;
  PlainScene& operator=(const PlainScene&) = delete;

  RTCRayHit trace(const Ray& ray) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    RTCRayHit hit{};
    hit.ray.org_x = static_cast<float>(ray.origin.x());
    hit.ray.org_y = static_cast<float>(ray.origin.y());
    hit.ray.org_z = static_cast<float>(ray.origin.z());
    hit.ray.dir_x = static_cast<float>(ray.direction.x());
    hit.ray.dir_y = static_cast<float>(ray.direction.y());
    hit.ray.dir_z = static_cast<float>(ray.direction.z());
    hit.ray.tfar = std::numeric_limits<float>::infinity();
    hit.ray.mask = ~0U;
    hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene_, &context, &hit);
    return hit;
  }

private:
  template <typename T>
  T* buffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, std::size_t stride,
            std::size_t count) {
    return static_cast<T*>(rtcSetNewGeometryBuffer(geometry, type, 0, format, stride, count));
  }

  void attach(RTCGeometry geometry) {
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
  }

  void add_tubes(const std::vector<Tube>& tubes) {
    for (const Tube& tube : tubes) {
      RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE);
      auto* vertices =
          buffer<float>(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4, 16, tube.nodes.size());
      for (const Node& node : tube.nodes) {
        vertices = std::copy_n(Eigen::Vector3f(node.position.cast<float>()).data(), 3, vertices);
        *vertices++ = static_cast<float>(tube.radius);
      }
      auto* indices =
          buffer<unsigned>(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT, 4, tube.edges.size());
      for (const Edge& edge : tube.edges) *indices++ = static_cast<unsigned>(edge.from);
      attach(geometry);
    }
  }

  void add_boxes(const std::array<Eigen::AlignedBox3d, 5>& all) {
    constexpr std::array<unsigned, 24> faces = {0, 1, 3, 2, 4, 6, 7, 5, 0, 4, 5, 1,
                                                2, 3, 7, 6, 0, 2, 6, 4, 1, 5, 7, 3};
    for (const Eigen::AlignedBox3d& box : all) {
      RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_QUAD);
      auto* vertices = buffer<float>(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, 12, 8);
      for (int corner = 0; corner < 8; ++corner) {
        const Eigen::Vector3f position =
            box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner)).cast<float>();
        vertices = std::copy_n(position.data(), 3, vertices);
      }
      std::copy(faces.begin(), faces.end(),
                buffer<unsigned>(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT4, 16, 6));
      attach(geometry);
    }
  }

  RTCDevice device_ = rtcNewDevice("threads=1");
  RTCScene scene_ = rtcNewScene(device_);
};

void plain_embree(benchmark::State& state, const char* camera_name) {
  const Bin bin;
  const auto tubes = pile(static_cast<int>(state.range(0)), bin);
  const Camera camera = camera_preset(camera_name);
  const PixelWindow window = scan({}, bin, camera).window;
  std::vector<float> distances(static_cast<std::size_t>(window.width) *
                               static_cast<std::size_t>(window.height));
  for (auto _ : state) {
    const PlainScene scene(tubes, bin);
    auto distance = distances.begin();
    for (int v = window.top; v < window.top + window.height; ++v) {
      for (int u = window.left; u < window.left + window.width; ++u) {
        *distance++ = scene.trace(ray_through(camera, u, v)).ray.tfar;
      }
    }
    benchmark::DoNotOptimize(distances.data());
  }
  state.counters["pixels"] = static_cast<double>(distances.size());
}

BENCHMARK_CAPTURE(exact_scan, paper, "paper")->Arg(1)->Arg(10)->Arg(20)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(plain_embree, paper, "paper")->Arg(1)->Arg(10)->Arg(20)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(exact_scan, zivid, "zivid-one-plus-l")->Arg(20)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(plain_embree, zivid, "zivid-one-plus-l")->Arg(20)->Unit(benchmark::kMillisecond);

}  // namespace
