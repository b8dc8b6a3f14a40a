#include "tanglebin/io/read_cloud.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "tanglebin/io/pcd.hpp"
#include "tanglebin/io/ply.hpp"
#include "tests/cloud/clouds.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/temporary_directory.hpp"

namespace tanglebin {
namespace {

using test::complaint;
PointCloud read(const std::string& file) {
  std::istringstream stream(file);
  return read_cloud(stream, "cloud");
}

TEST(ReadCloud, TellsPlyAndPcdApartWhateverTheName) {
  const test::TemporaryDirectory directory;
  const auto file = directory / "cloud.dat";
  {
    std::ofstream stream(file, std::ios::binary);
    write_ply(stream, small_cloud());
  }
  EXPECT_TRUE(same_properties(read_cloud(file), small_cloud()));
  {
    std::ofstream stream(file, std::ios::binary);
    write_pcd(stream, small_cloud());
  }
  EXPECT_TRUE(same_properties(read_cloud(file), small_cloud()));
}

TEST(ReadCloud, ReadsPcdWithoutAComment) {
  const std::string header =
      "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 1\nHEIGHT 1\nDATA ascii\n";
  EXPECT_EQ(read(header + "1 2 3\n").points.at(0), Eigen::Vector3f(1, 2, 3));
}

TEST(ReadCloud, RefusesEverythingElse) {
  EXPECT_EQ(
      complaint([] { read(""); }),
      "cloud: found an empty file, expected a PLY file, which begins with ply, a PCD file, which begins "
      "with # or VERSION, or a depth image, PNG or NPY");
  EXPECT_EQ(complaint([] { read("\x8aPNG"); }),
            "cloud: found '\\x8a' at the start, expected a PLY file, which begins with ply, a PCD file, "
            "which begins with # or VERSION, or a depth image, PNG or NPY");
  for (const std::string image : {"\x89PNG", "\x93NUMPY"}) {
    EXPECT_EQ(complaint([&] { read(image); }),
              "cloud: found a depth image, expected a cloud, or also the camera that makes one of it");
  }
  EXPECT_EQ(complaint([] { read("paper\n"); }),
            "cloud:1: found 'paper', expected ply, the first line of a PLY file");
  EXPECT_EQ(complaint([] { read_cloud(std::filesystem::path("no/such.pcd")); }),
            "no/such.pcd: cannot be opened: No such file or directory");
}

}  // namespace
}  // namespace tanglebin
