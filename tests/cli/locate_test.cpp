#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tanglebin/io/ply.hpp"
#include "tanglebin/scene/read_scene.hpp"
#include "tests/model/scene/scanned.hpp"
#include "tests/support/program.hpp"

namespace tanglebin {
namespace {

using test::ProgramResult;
using test::run_program;
using testing::AllOf;
using testing::HasSubstr;

/// A tube in the paper's bin, scanned; the cloud is in the camera's frame, and nobody knows where the bin is.
class LocateCommand : public testing::Test {
protected:
  LocateCommand() {
    PointCloud cloud = test::scanned({test::straight_tube(1, 0.05)});
    const Eigen::Isometry3d to_camera = camera_.pose.inverse(Eigen::Isometry);
    for (Eigen::Vector3f& point : cloud.points) point = (to_camera * point.cast<double>()).cast<float>();
    write_cloud(cloud);
    write_scene_of(0.55);
  }

  void write_scene_of(double length) const {
    write_scene_with(
        fmt::format("shape = \"bin\"\nlength = {}\nwidth = 0.37\nheight = 0.2\nwall = 0.02\n", length));
  }
  void write_scene_with(const std::string& support) const {
    test::write_bytes(
        directory_ / "scene.toml",
        fmt::format("[camera]\nwidth = {}\nheight = {}\nfx = {}\nfy = {}\ncx = {}\ncy = {}\n"
                    "frame = \"camera\"\nunit = \"m\"\n\n[support]\n{}\n"
                    "[[tube]]\nradius = 0.0125\nlength = 0.5\n",
                    camera_.width, camera_.height, camera_.fx, camera_.fy, camera_.cx, camera_.cy, support));
  }
  // Puts a table level with the rim around the bin: nothing shows how thick its walls are.
  void hide_outsides_of_walls() const {
    PointCloud cloud = read_ply(path("scan.ply"));
    const Bin bin = bin_preset("paper");
    for (int v = 0; v < camera_.height; ++v) {
      for (int u = 0; u < camera_.width; ++u) {
        const Ray ray = ray_through(camera_, u, v);
        const Eigen::Vector3d point =
            ray.origin + (bin.height - ray.origin.z()) / ray.direction.z() * ray.direction;
        if (std::abs(point.x()) > bin.length / 2 + bin.wall || std::abs(point.y()) > bin.width / 2 + bin.wall)
          cloud.points.emplace_back((camera_.pose.inverse(Eigen::Isometry) * point).cast<float>());
      }
    }
    write_cloud(cloud);
  }
  void write_cloud(PointCloud cloud) const {
    cloud = test::cloud_of(cloud.points);
    std::ostringstream out;
    write_ply(out, cloud);
    test::write_bytes(directory_ / "scan.ply", out.str());
  }
  std::string path(const std::string& name) const { return (directory_ / name).string(); }
  ProgramResult locate(const std::string& options) const {
    return run_program("locate " + path("scan.ply") + " --scene " + path("scene.toml") + " " + options);
  }

  Camera camera_ = camera_preset("paper");
  test::TemporaryDirectory directory_;
};

TEST_F(LocateCommand, WritesASceneInWhichTheBinIsWhereItWasFound) {
  const ProgramResult run = locate("--out " + path("located.toml"));
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out,
              AllOf(HasSubstr("position"), HasSubstr("residual"), HasSubstr("floor"), HasSubstr("rim")));
  const Eigen::Isometry3d truth = camera_.pose.inverse(Eigen::Isometry);
  const Eigen::Isometry3d found = read_scene(directory_ / "located.toml").support->pose;
  EXPECT_LT((found.translation() - truth.translation()).norm(), 0.001);
  EXPECT_LT(found.linear().col(2).cross(truth.linear().col(2)).norm(), 0.001);
}

TEST_F(LocateCommand, PrintsJson) {
  const ProgramResult run = locate("--json");
  ASSERT_EQ(run.status, 0) << run.err;
  const nlohmann::json json = nlohmann::json::parse(run.out);
  EXPECT_EQ(json["shape"], "bin");
  EXPECT_NEAR(json["support_to_world"][2][3].get<double>(), 2, 0.001);
  EXPECT_NEAR(json["measured"]["length"].get<double>(), 0.55, 0.001);
  EXPECT_GT(json["explained"].get<double>(), 0.9);
  EXPECT_TRUE(json.at("notes").empty());  // frame and unit are told
}

TEST_F(LocateCommand, PrintsTheWallOnlyIfItIsSeen) {
  EXPECT_THAT(locate("").out, HasSubstr("m, wall 0.0"));
  EXPECT_TRUE(nlohmann::json::parse(locate("--json").out)["measured"]["wall"].is_number());
  hide_outsides_of_walls();
  write_scene_with("shape = \"bin\"\nlength = 0.55\nwidth = 0.37\nheight = 0.2\n");
  const ProgramResult run = locate("");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("how thick the walls are is not seen"));
  EXPECT_THAT(run.out, AllOf(HasSubstr("sizes "), testing::Not(HasSubstr("wall 0."))));
  EXPECT_TRUE(nlohmann::json::parse(locate("--json").out)["measured"].at("wall").is_null());
}

TEST_F(LocateCommand, SaysWhichPartsOfAPoseAPlaneLeavesOpen) {
  write_scene_with("shape = \"plane\"\n");
  const ProgramResult run = locate("");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, testing::ContainsRegex("±  +- +- +[0-9.]+ mm along"));
  EXPECT_THAT(run.out, testing::ContainsRegex("±  +[0-9.]+ +[0-9.]+ +- degrees about"));
  const nlohmann::json json = nlohmann::json::parse(locate("--json").out);
  const nlohmann::json& position = json.at("position_sd_mm");
  const nlohmann::json& rotation = json.at("rotation_sd_deg");
  EXPECT_TRUE(position[0].is_null() && position[1].is_null() && position[2].is_number()) << position;
  EXPECT_TRUE(rotation[0].is_number() && rotation[1].is_number() && rotation[2].is_null()) << rotation;
}

TEST_F(LocateCommand, SaysWhyABinIsNotFound) {
  write_scene_of(0.45);
  const ProgramResult run = locate("--out " + path("located.toml"));
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, AllOf(HasSubstr("scan.ply"), HasSubstr("not located")));
  EXPECT_FALSE(std::filesystem::exists(directory_ / "located.toml"));
}

TEST_F(LocateCommand, NeedsAScene) {
  const ProgramResult run = run_program("locate " + path("scan.ply"));
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, HasSubstr("[support]"));
}

TEST_F(LocateCommand, ModelDoesBoth) {
  const ProgramResult run = run_program("model " + path("scan.ply") + " --scene " + path("scene.toml") +
                                        " --locate --out " + path("labelled.ply") + " --json");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(nlohmann::json::parse(run.out)["tubes"], 1);
}

// The frame of a bin whose walls are bent: its sizes are read from the picture.
TEST(LocateReal, FindsTheBinOfARealFrame) {
  const std::filesystem::path real = TANGLEBIN_SOURCE "/../shared/real";
  if (!std::filesystem::exists(real / "raw-frame.png")) GTEST_SKIP() << "no real scans in " << real;
  const test::TemporaryDirectory directory;
  const std::string cloud = (directory / "raw.ply").string();
  const std::string camera = (directory / "raw.json").string();
  const std::string convert = "/usr/bin/python3 " + (real / "to_cloud.py").string() + " " +
                              (real / "raw-frame.png").string() + " " + cloud + " " + camera +
                              " > /dev/null 2>&1";
  if (std::system(convert.c_str()) != 0) GTEST_SKIP() << "to_cloud.py needs python3-numpy and python3-pil";
  test::write_bytes(directory / "scene.toml",
                    "[camera]\nfile = \"raw.json\"\nframe = \"camera\"\nunit = \"m\"\n\n[support]\nshape = "
                    "\"bin\"\nlength = 0.435\nwidth = 0.357\nheight = 0.07\nwall = 0.008\nmargin = 0.005\n");
  const ProgramResult run =
      run_program("locate --json " + cloud + " --scene " + (directory / "scene.toml").string());
  ASSERT_EQ(run.status, 0) << run.err;
  const nlohmann::json json = nlohmann::json::parse(run.out);
  EXPECT_LT(json["residual_mm"].get<double>(), 6);
  EXPECT_GT(json["explained"].get<double>(), 0.7);
  EXPECT_GT(json["support_to_world"][2][2].get<double>(), 0.998);
}

}  // namespace
}  // namespace tanglebin
