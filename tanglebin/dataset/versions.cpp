#include "tanglebin/dataset/versions.hpp"

#include <embree3/rtcore_config.h>
#include <fmt/core.h>
#include <gnu/libc-version.h>
#include <png.h>
#include <sys/utsname.h>
#include <zlib.h>

#include <Eigen/Core>
#include <boost/version.hpp>
#include <limits>

#include "tanglebin/dataset/sha256.hpp"
#include "tanglebin/io/read_file.hpp"

namespace tanglebin {
namespace {

// The C library computes sine and cosine otherwise where the processor has fused multiply-add.
std::string machine() {
  utsname name{};
  uname(&name);
#ifdef __x86_64__
  if (__builtin_cpu_supports("fma") == 0) return fmt::format("{} without FMA", name.machine);
#endif
  return name.machine;
}

}  // namespace

Versions versions() {
  return {
      {"tanglebin", TANGLEBIN_VERSION},
      {"compiler", TANGLEBIN_COMPILER},
      {"ode", TANGLEBIN_ODE_VERSION},
      {"embree", RTC_VERSION_STRING},
      {"eigen", fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
      {"boost",
       fmt::format("{}.{}.{}", BOOST_VERSION / 100000, BOOST_VERSION / 100 % 1000, BOOST_VERSION % 100)},
      {"libpng", png_get_libpng_ver(nullptr)},
      {"zlib", zlibVersion()},
      {"glibc", gnu_get_libc_version()},
      {"machine", machine()},
  };
}

const std::string& program_sha256() {
  static const std::string hash =
      sha256(read_file("/proc/self/exe", std::numeric_limits<std::size_t>::max()));
  return hash;
}

}  // namespace tanglebin
