#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tanglebin/io/configuration.hpp"
#include "tanglebin/io/pcd.hpp"
#include "tanglebin/io/ply.hpp"
#include "tests/support/program.hpp"

namespace tanglebin {
namespace {

using test::bytes_of;
using test::run_program;
using test::TemporaryDirectory;
using test::write_bytes;
using testing::Contains;
using testing::Each;
using testing::HasSubstr;

// One straight tube along x that lies on the floor.
std::vector<std::filesystem::path> published_files() {
  std::vector<std::filesystem::path> files;
  if (!std::filesystem::exists(TANGLEBIN_PUBLISHED)) return files;
  for (const auto& entry : std::filesystem::directory_iterator(TANGLEBIN_PUBLISHED)) {
    if (entry.path().extension() == ".txt") files.push_back(entry.path());
  }
  return files;
}

class ScanCommand : public testing::Test {
protected:
  static constexpr const char* one_tube = R"(1
1 2 1
1 -0.2 0 0.0125 0.0125
2 0.2 0 0.0125 0.0125
e_1_2 1 2 1 0.0125 0 0 0.0125 0.70710678 0 0.70710678 0 0.4
)";

  ScanCommand() { write_bytes(configuration_, one_tube); }

  TemporaryDirectory directory_;
  std::filesystem::path configuration_ = directory_ / "tube.txt";
};

TEST_F(ScanCommand, GivesTheTubesPointsAndWithBinTheBinsToo) {
  const std::string cloud = (directory_ / "cloud.ply").string();
  const auto tubes_only = run_program("scan " + configuration_.string() + " --out " + cloud);
  EXPECT_EQ(tubes_only.status, 0) << tubes_only.err;
  EXPECT_THAT(tubes_only.out, HasSubstr("points on 1 tubes"));
  EXPECT_THAT(read_ply(cloud).labels, Each(1));
  run_program("scan " + configuration_.string() + " --with-bin --out " + cloud);
  EXPECT_THAT(read_ply(cloud).labels, Contains(0));
  EXPECT_THAT(read_ply(cloud).labels, Contains(1));
}

TEST_F(ScanCommand, WritesAnOrganizedCloudImagesAndTheirCamera) {
  const auto result =
      run_program("scan " + configuration_.string() + " --scanner zivid-one-plus-l --out " +
                  (directory_ / "cloud.pcd").string() + " --depth " + (directory_ / "d.png").string() +
                  " --labels " + (directory_ / "l.png").string());
  EXPECT_EQ(result.status, 0) << result.err;
  const PointCloud cloud = read_pcd(directory_ / "cloud.pcd");
  EXPECT_EQ(cloud.width, 1920U);
  EXPECT_EQ(cloud.height, 1200U);
  EXPECT_EQ(bytes_of(directory_ / "d.png").substr(1, 3), "PNG");
  EXPECT_EQ(bytes_of(directory_ / "l.png").substr(1, 3), "PNG");
  const auto camera = nlohmann::json::parse(bytes_of(directory_ / "d.json"));
  EXPECT_EQ(camera["intrinsic_matrix"][0], 2730.0);
}

TEST_F(ScanCommand, SeesLikeARealScannerWhereAsked) {
  const std::string command = "scan " + configuration_.string() + " --with-bin --out ";
  const std::string ideal = (directory_ / "ideal.ply").string();
  const std::string noisy = (directory_ / "noisy.ply").string();
  const std::string picture = (directory_ / "picture.png").string();
  run_program(command + ideal);
  const auto result =
      run_program(command + noisy + " --set scanner.dropout=0.5 --set scanner.sigma=0.001 --seed 1f" +
                  " --normals --intensities --mixed --picture " + picture);
  EXPECT_EQ(result.status, 0) << result.err;
  const PointCloud cloud = read_ply(noisy);
  EXPECT_NEAR(static_cast<double>(cloud.points.size()) / static_cast<double>(read_ply(ideal).points.size()),
              0.5, 0.02);
  EXPECT_EQ(cloud.normals.size(), cloud.points.size());
  EXPECT_THAT(cloud.intensities, Each(1.0F));
  EXPECT_THAT(cloud.mixed, Each(0));
  EXPECT_EQ(bytes_of(picture).substr(1, 3), "PNG");
  EXPECT_EQ(run_program(command + "- --scanner zivid-one-plus-l --seed 1").out,
            run_program(command + "- --scanner zivid-one-plus-l --seed 1").out);
}

TEST_F(ScanCommand, NamesTheSettingThatIsWrong) {
  const auto said = [&](const std::string& options) {
    const auto result = run_program("scan " + configuration_.string() + " --out " +
                                    (directory_ / "cloud.ply").string() + " " + options);
    EXPECT_EQ(result.status, 2);
    EXPECT_FALSE(std::filesystem::exists(directory_ / "cloud.ply"));
    return result.err;
  };
  EXPECT_THAT(said("--set scanner.sigma=0.1 --set scanner.baseline=0"),
              HasSubstr("--set:2: scanner.baseline: found 0, expected a positive distance"));
  EXPECT_THAT(said("--set scanner.snr=-1"), HasSubstr("scanner.snr: found -1"));
  EXPECT_THAT(said("--set scanner.focal_length_px=0"), HasSubstr("scanner.focal_length_px: found 0"));
  EXPECT_THAT(said("--set scanner.edges=blur"), HasSubstr("\"keep\", \"drop\" or \"mix\""));
  EXPECT_THAT(said("--seed 0x1"), HasSubstr("--seed: found '0x1'"));
}

TEST_F(ScanCommand, StandardInputAndOutputTakeAndGiveTheSame) {
  const std::string file = (directory_ / "cloud.ply").string();
  run_program("scan " + configuration_.string() + " --out " + file);
  const auto piped = run_program("scan - --out -", one_tube);
  EXPECT_EQ(piped.status, 0);
  EXPECT_EQ(piped.out, bytes_of(file));
}

TEST_F(ScanCommand, SummarizesAsJson) {
  const auto result =
      run_program("scan " + configuration_.string() + " --json --out " + (directory_ / "cloud.ply").string());
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json["tubes"][0]["label"], 1);
  EXPECT_EQ(json["tubes"][0]["points"], read_ply(directory_ / "cloud.ply").points.size());
}

TEST_F(ScanCommand, BadInputIsExitStatusTwoAndLeavesNothing) {
  const std::string out = " --out " + (directory_ / "cloud.ply").string();
  auto result = run_program("scan " + (directory_ / "none.txt").string() + out);
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("none.txt: "));
  result = run_program("scan -" + out, "1\n1 2 1\n1 0 0 0 -3\n");
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err,
              HasSubstr("tanglebin: standard input:3: radius: found '-3', expected a positive number"));
  result = run_program("scan " + configuration_.string() + out + " --bin round");
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("round"));
  result = run_program("scan " + configuration_.string() + out + " --scanner sonar");
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("sonar"));
  EXPECT_FALSE(std::filesystem::exists(directory_ / "cloud.ply"));
  result =
      run_program("scan " + configuration_.string() + " --out " + (directory_ / "no" / "cloud.ply").string());
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(run_program("scan " + configuration_.string() + " --out /dev/full").status, 5);
}

TEST_F(ScanCommand, TakesEveryPublishedFile) {
  const auto files = published_files();
  if (files.empty()) GTEST_SKIP() << "no published files in " << TANGLEBIN_PUBLISHED;
  for (const auto& file : files) {
    const auto result = run_program("scan " + file.string() + " --bin published --json --out " +
                                    (directory_ / "cloud.ply").string());
    ASSERT_EQ(result.status, 0) << file << result.err;
    const auto json = nlohmann::json::parse(result.out);
    EXPECT_EQ(json["tubes"].size(), read_configuration(file).size());
    EXPECT_GT(read_ply(directory_ / "cloud.ply").points.size(), 1000U);
  }
}

}  // namespace
}  // namespace tanglebin
