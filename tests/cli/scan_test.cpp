#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
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
using test::files_below;
using test::run_program;
using test::run_shell;
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
  EXPECT_THAT(tubes_only.out, HasSubstr("points on 1 tube, "));
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

TEST_F(ScanCommand, LeavesNothingBehindWhereAnOutputCannotBeMade) {
  std::string text = one_tube;
  text.replace(2, 1, "70000");  // the tube's id, too large for a label image
  write_bytes(configuration_, text);
  const auto result =
      run_program("scan " + configuration_.string() + " --out " + (directory_ / "cloud.ply").string() +
                  " --labels " + (directory_ / "labels.png").string());
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("label 70000"));
  EXPECT_EQ(files_below(directory_.path()).size(), 1U) << "only the configuration";
}

TEST_F(ScanCommand, LeavesNothingBehindWhereAnOutputCannotBeWritten) {
  for (const char* missing : {"--depth", "--labels", "--picture"}) {
    const auto result =
        run_program("scan " + configuration_.string() + " --out " + (directory_ / "cloud.ply").string() +
                    " " + missing + " " + (directory_ / "none" / "image.png").string());
    EXPECT_EQ(result.status, 2);
    EXPECT_THAT(result.err, HasSubstr("none/image.png: cannot write: No such file or directory"));
    EXPECT_EQ(files_below(directory_.path()).size(), 1U) << missing << ": only the configuration";
  }
}

TEST_F(ScanCommand, SeesLikeARealScannerWhereAsked) {
  const std::string command = "scan " + configuration_.string() + " --with-bin --out ";
  const std::string ideal = (directory_ / "ideal.ply").string();
  const std::string noisy = (directory_ / "noisy.ply").string();
  const std::string picture = (directory_ / "picture.png").string();
  run_program(command + ideal);
  const auto result = run_program(
      command + noisy + " --parameter scanner.dropout=0.5 --parameter scanner.sigma=0.001 --seed 0x1f" +
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
  EXPECT_THAT(
      said("--parameter scanner.sigma=0.1 --parameter scanner.baseline=0"),
      HasSubstr("--parameter: scanner.baseline: found 0, expected a distance in metres other than 0"));
  EXPECT_THAT(said("--parameter scanner.sigma"),
              HasSubstr("--parameter: found 'scanner.sigma', expected NAME=VALUE, such as scanner.base"));
  EXPECT_THAT(said("--scanner zivid"),
              HasSubstr("--scanner: found 'zivid', did you mean 'zivid-one-plus-l'?"));
  EXPECT_THAT(said("--bin papers"), HasSubstr("--bin: found 'papers', did you mean 'paper'?"));
  EXPECT_THAT(said("--parameter scanner.snr=-1"), HasSubstr("scanner.snr: found -1"));
  EXPECT_THAT(said("--parameter scanner.focal_length_px=0"), HasSubstr("scanner.focal_length_px: found 0"));
  EXPECT_THAT(said("--parameter scanner.edges=blur"), HasSubstr("\"keep\", \"drop\" or \"mix\""));
  EXPECT_THAT(said("--seed 1f"),
              HasSubstr("--seed: found '1f', expected a seed of at most 64 bits: decimal, or"));
}

TEST_F(ScanCommand, RefusesACameraThatCannotSeeTheBin) {
  const auto said = [&](const std::string& settings) {
    const auto result = run_program("scan " + configuration_.string() + " --out - " + settings);
    EXPECT_EQ(result.status, 2);
    EXPECT_EQ(result.out, "");
    return result.err;
  };
  EXPECT_THAT(
      said("--parameter scanner.position=[0,0,-1]"),
      HasSubstr("scanner.position: found a camera at (0, 0, -1) m that looks along (0, 0, -1), expected one "
                "above the bin's floor, z > 0"));
  EXPECT_THAT(said("--parameter scanner.position=[9,0,2]"),
              HasSubstr("expected one that has the bin in its view"));
}

TEST_F(ScanCommand, WarnsOfAScanWithoutATube) {
  const std::string far_away = R"(1
1 2 1
1 -200 0 12.5 12.5
2 -100 0 12.5 12.5
e_1_2 1 2 1 12.5 -150 0 12.5 0.70710678 0 0.70710678 0 100
)";
  const auto result = run_program("scan - --out " + (directory_ / "cloud.ply").string(), far_away);
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(
      result.err,
      "tanglebin: warning: the scan has no point of a tube; the tubes are between (-212.5, -12.5, 0) and "
      "(-87.5, 12.5, 25) m, the camera at (0, 0, 2)\n");
}

TEST_F(ScanCommand, TheExtensionSaysTheFormat) {
  const auto said = [&](const std::string& outputs) {
    const auto result = run_shell("cd " + directory_.path().string() + " && " + TANGLEBIN_PROGRAM +
                                  " scan tube.txt --out " + outputs);
    EXPECT_EQ(result.status, 2);
    return result.err;
  };
  EXPECT_EQ(said("x.obj"), "tanglebin: --out: found 'x.obj', expected a name that ends in .ply or .pcd\n");
  EXPECT_EQ(said("ply"), "tanglebin: --out: found 'ply', expected a name that ends in .ply or .pcd\n");
  EXPECT_EQ(said("c.ply --depth d.tiff"),
            "tanglebin: --depth: found 'd.tiff', expected a name that ends in .png\n");
  EXPECT_THAT(said("c.ply --depth -"), HasSubstr("--depth: found '-', expected a file's name"));
  EXPECT_THAT(said("c.ply --labels l.jpg"), HasSubstr("--labels: found 'l.jpg'"));
  EXPECT_THAT(said("c.ply --picture p.jpg"), HasSubstr("--picture: found 'p.jpg'"));
  EXPECT_EQ(said("c.ply --labels a.png --picture a.png"),
            "tanglebin: --picture: found 'a.png' twice, expected different files\n");
  EXPECT_THAT(said("- --labels -"), HasSubstr("--labels: found '-' twice"));
  EXPECT_THAT(said("c.ply --labels a.png --picture ./a.png"), HasSubstr("--picture: found './a.png' twice"));
  EXPECT_EQ(files_below(directory_.path().string()).size(), 1U) << "nothing is written";

  run_program("scan " + configuration_.string() + " --out " + (directory_ / "CLOUD.PCD").string());
  EXPECT_EQ(read_pcd(directory_ / "CLOUD.PCD").width, 1920U);
}

TEST_F(ScanCommand, ReadsASeedOfAnyLengthAsDecimalUnlessItBeginsWith0x) {
  const std::string command =
      "scan " + configuration_.string() + " --out - --parameter scanner.dropout=0.5 --seed ";
  const auto decimal = run_program(command + "0000000000000167");
  EXPECT_EQ(decimal.err, "");
  EXPECT_EQ(decimal.out, run_program(command + "167").out);
  EXPECT_EQ(decimal.out, run_program(command + "0x00000000000000a7").out);
  EXPECT_NE(decimal.out, run_program(command + "168").out);
  const auto without_prefix = run_program(command + "00000000000000a7");
  EXPECT_EQ(without_prefix.status, 2);
  EXPECT_EQ(without_prefix.err,
            "tanglebin: --seed: found '00000000000000a7', expected a seed of at most 64 bits: decimal, or "
            "hexadecimal after 0x\n");
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

TEST_F(ScanCommand, ScansAsASceneFileSays) {
  const std::string scene = (directory_ / "scene.toml").string();
  const std::string out = (directory_ / "cloud.ply").string();
  const std::string command =
      "scan " + configuration_.string() + " --with-bin --out " + out + " --scene " + scene;
  const std::string camera =
      "[camera]\nwidth = 200\nheight = 150\nhfov_deg = 40\nposition = [0.2, 0, 1]\nlook_at = [0, 0, 0]\n";
  write_bytes(scene, camera + "[support]\nshape = \"plane\"\nposition = [0, 0, -0.1]\n");
  const auto over_a_plane = run_program(command + " --scanner gaussian");
  ASSERT_EQ(over_a_plane.status, 0) << over_a_plane.err;
  EXPECT_THAT(over_a_plane.err,
              HasSubstr("the camera is the scene's; only the sensor is that of --scanner gaussian"));
  const PointCloud on_plane = read_ply(std::filesystem::path(out));
  EXPECT_EQ(on_plane.labels.size(), on_plane.points.size());
  float lowest = 0;
  for (const Eigen::Vector3f& point : on_plane.points) lowest = std::min(lowest, point.z());
  EXPECT_NEAR(lowest, -0.1, 0.005);

  write_bytes(scene, camera + "[support]\nshape = \"nothing\"\n");
  ASSERT_EQ(run_program(command).status, 0);
  EXPECT_THAT(read_ply(std::filesystem::path(out)).labels, Each(1));

  write_bytes(scene, "[camera]\nfx = 500\nfy = 500\ncx = 0\ncy = 0\n");
  const auto half = run_program(command);
  EXPECT_EQ(half.status, 2);
  EXPECT_THAT(half.err,
              HasSubstr("camera: found a camera without pose, intrinsics or the size of its image"));
  EXPECT_EQ(run_program(command + " --bin paper").status, 64);
}

TEST_F(ScanCommand, DoesNotOverwriteItsSceneOrTheScenesCamera) {
  const std::string scene = (directory_ / "scene.ply").string();
  const std::string camera = (directory_ / "camera.json").string();
  write_bytes(scene, "[camera]\nfile = \"camera.json\"\nposition = [0, 0, 1]\nlook_at = [0, 0, 0]\n");
  write_bytes(camera, R"({"fx": 500, "fy": 500, "cx": 100, "cy": 75, "width": 200, "height": 150})");
  const auto before = files_below(directory_.path());
  for (const auto& [options, complaint] : std::vector<std::pair<std::string, std::string>>{
           {"--out " + scene, "--out: found '" + scene + "', which is also an input"},
           {"--out " + (directory_ / "out.ply").string() + " --depth " + (directory_ / "camera.png").string(),
            "--depth: found '" + camera + "', which is also an input"}}) {
    const auto result = run_program("scan " + configuration_.string() + " --scene " + scene + " " + options);
    EXPECT_EQ(result.status, 2);
    EXPECT_THAT(result.err, HasSubstr(complaint));
  }
  EXPECT_EQ(files_below(directory_.path()), before);
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
