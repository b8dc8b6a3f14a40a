#include "tanglebin/dataset/versions.hpp"

#include <dlfcn.h>
#include <embree3/rtcore_config.h>
#include <fmt/core.h>
#include <gnu/libc-version.h>
#include <link.h>
#include <png.h>
#include <sys/utsname.h>
#include <zlib.h>

#include <Eigen/Core>
#include <boost/version.hpp>
#include <limits>
#include <string>

#include "tanglebin/dataset/sha256.hpp"
#include "tanglebin/files/read_file.hpp"

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

// The file with this code: the program, or a shared library such as Python's module.
std::string file_of_this_code() {
  Dl_info info{};
  void* object = nullptr;
  dladdr1(reinterpret_cast<const void*>(&file_of_this_code), &info, &object, RTLD_DL_LINKMAP);
  const std::string library = object ? static_cast<const link_map*>(object)->l_name : "";
  return library.empty() ? "/proc/self/exe" : library;
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
      sha256(read_file(file_of_this_code(), std::numeric_limits<std::size_t>::max()));
  return hash;
}

}  // namespace tanglebin
