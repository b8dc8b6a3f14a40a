#include "tanglebin/io/read_cloud.hpp"

#include <istream>

#include "tanglebin/base/text.hpp"
#include "tanglebin/files/read_file.hpp"
#include "tanglebin/io/cloud_input.hpp"
#include "tanglebin/io/depth_input.hpp"
#include "tanglebin/io/pcd.hpp"
#include "tanglebin/io/ply.hpp"

namespace tanglebin {

PointCloud read_cloud(std::istream& in, const std::string& name) {
  constexpr auto end_of_file = std::istream::traits_type::eof();
  const std::string expected =
      "a PLY file, which begins with ply, a PCD file, which begins with # or VERSION, or a depth image, PNG "
      "or NPY";
  const auto first = in.peek();
  if (is_depth_image(in))
    throw InputError({name, 0, ""}, "a depth image", "a cloud, or also the camera that makes one of it");
  if (first == end_of_file) throw InputError({name, 0, ""}, "an empty file", expected);
  if (first == 'p') return read_ply(in, name);
  if (first == '#' || first == 'V') return read_pcd(in, name);
  const char character = std::istream::traits_type::to_char_type(first);
  throw InputError({name, 0, ""}, excerpt({&character, 1}) + " at the start", expected);
}

PointCloud read_cloud(const std::filesystem::path& file) {
  std::ifstream stream = open_input(file);
  return read_cloud(stream, file.string());
}

}  // namespace tanglebin
