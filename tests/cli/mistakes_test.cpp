#include "tests/model/mistakes.hpp"

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tanglebin/io/images.hpp"
#include "tanglebin/io/pcd.hpp"
#include "tanglebin/io/ply.hpp"
#include "tanglebin/io/read_cloud.hpp"
#include "tanglebin/scene/write_scene.hpp"
#include "tests/support/program.hpp"

namespace tanglebin {
namespace {

using test::ProgramResult;
using test::View;
using testing::AllOf;
using testing::HasSubstr;

/// A scan and its scene file, with a mistake in one of them, through the program.
class MistakeInModel : public testing::Test {
protected:
  std::string path(const std::string& name) const { return (directory_ / name).string(); }
  void write(const std::string& name, const std::string& bytes) const {
    test::write_bytes(directory_ / name, bytes);
  }
  bool is_labelled() const { return std::filesystem::exists(directory_ / "labelled.ply"); }

  static std::string ply_of(const PointCloud& cloud) {
    std::ostringstream out;
    write_ply(out, cloud);
    return out.str();
  }
  static std::string pcd_of(const PointCloud& cloud) {
    std::ostringstream out;
    write_pcd(out, cloud);
    return out.str();
  }
  // All that is known, frame and unit too.
  void write_scene_of(const KnownScene& known) const {
    std::ostringstream out;
    write_scene(out, scene_of(known));
    write("scene.toml", out.str());
  }
  ProgramResult model(const std::string& input, const std::string& options = "") const {
    return test::run_program("model " + path(input) + " --scene " + path("scene.toml") + " --out " +
                             path("labelled.ply") + " " + options);
  }
  // Of the points alone: a mistake may change how many there are.
  ProgramResult model(const View& view) const {
    PointCloud cloud = view.cloud;
    cloud.labels.clear();
    cloud.colors.clear();
    write("scan.ply", ply_of(cloud));
    write_scene_of(view.scene);
    return model("scan.ply", "--json");
  }
  std::vector<int> labels() const { return read_cloud(directory_ / "labelled.ply").labels; }

  test::TemporaryDirectory directory_;
};

bool has_finding(const nlohmann::json& printed, const std::string& code, const std::string& severity) {
  return std::ranges::any_of(printed.at("findings"), [&](const nlohmann::json& finding) {
    return finding.at("code") == code && finding.at("severity") == severity;
  });
}

TEST_F(MistakeInModel, NoneGivesNoWord) {
  const ProgramResult run = model(test::right_view());
  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(run.err, "");
  EXPECT_EQ(nlohmann::json::parse(run.out).at("tubes"), 4);
}

TEST_F(MistakeInModel, IsNamedWithItsStatus) {
  for (const test::Mistake& mistake : test::mistakes()) {
    View view = test::right_view();
    mistake.make(view);
    const ProgramResult run = model(view);
    const bool is_error = mistake.severity == Finding::Severity::error;
    EXPECT_EQ(run.status, is_error ? 6 : 0) << mistake.name << ": " << run.err;
    EXPECT_THAT(run.err,
                AllOf(HasSubstr(is_error ? "scan.ply: " : "scan.ply: warning: "), HasSubstr(mistake.words)))
        << mistake.name;
    EXPECT_TRUE(is_labelled()) << mistake.name;
    const auto printed = nlohmann::json::parse(run.out);
    EXPECT_EQ(printed.at("usable"), !is_error) << mistake.name;
    EXPECT_TRUE(has_finding(printed, mistake.code, is_error ? "error" : "warning")) << mistake.name;
  }
}

TEST_F(MistakeInModel, OfFrameOrUnitOnTheCommandLineIsNamed) {
  write("scan.ply", ply_of(test::right_view().cloud));
  write_scene_of(test::right_view().scene);
  for (const auto& [options, remedy] : std::vector<std::pair<std::string, std::string>>{
           {"--frame camera", "in the world frame (--frame world)"},
           {"--unit mm", "in metres (--unit m)"},
           {"--frame camera --unit mm", "--unit m"}}) {
    const ProgramResult run = model("scan.ply", options);
    EXPECT_EQ(run.status, 6) << options;
    EXPECT_THAT(run.err, HasSubstr(remedy)) << options;
  }
}

TEST_F(MistakeInModel, OfMillimetresInTheSceneIsRefused) {
  const View view = test::right_view();
  write("scan.ply", ply_of(view.cloud));
  write_scene_of(view.scene);
  for (const auto& [options, message] : std::vector<std::pair<std::string, std::string>>{
           {"--radius 12.5", "for 12.5 mm write 0.0125"}, {"--length 480", "--length: found 480 m"}}) {
    const ProgramResult run = model("scan.ply", options);
    EXPECT_EQ(run.status, 2) << options;
    EXPECT_THAT(run.err, HasSubstr(message));
  }
  write(
      "scene.toml",
      "[camera]\npreset = \"paper\"\n[support]\nshape = \"bin\"\nlength = 550\nwidth = 370\nheight = 200\n");
  const ProgramResult run = model("scan.ply", "--radius 0.0125");
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, HasSubstr("support.length: found 550"));
  EXPECT_FALSE(is_labelled());
}

TEST_F(MistakeInModel, OfTheCameraThatAnOrganizedCloudGivesAwayIsRefused) {
  View view = test::right_view();
  write("scan.pcd", pcd_of(test::organized()));
  view.scene.camera.fx *= 1.5;
  view.scene.camera.fy *= 1.5;
  write_scene_of(view.scene);
  const ProgramResult run = model("scan.pcd");
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, HasSubstr("which the organized cloud shows; is the camera another's?"));
  EXPECT_FALSE(is_labelled());
}

TEST_F(MistakeInModel, OfADepthImagesScaleIsNamed) {
  const View view = test::right_view();
  write_scene_of(view.scene);
  write("depth.png", depth_png(depth_image(scan(test::heap(), view.scene.support.bin, view.scene.camera))));
  const ProgramResult run = model("depth.png", "--frame camera --unit mm");
  EXPECT_EQ(run.status, 6) << run.err;
  EXPECT_THAT(run.err, HasSubstr("they would fit with depth_scale = 10000 in [camera]\n"));
  const ProgramResult located = model("depth.png", "--frame camera --unit mm --locate");
  EXPECT_EQ(located.status, 2) << located.err;
  EXPECT_THAT(located.err, HasSubstr("; it would fit with depth_scale = 10000 in [camera]\n"));
}

// A file that ends too early, as a copy does that was interrupted.
TEST_F(MistakeInModel, OfATruncatedFileIsRefused) {
  const View view = test::right_view();
  write_scene_of(view.scene);
  const std::string depth =
      depth_png(depth_image(scan(test::heap(), view.scene.support.bin, view.scene.camera)));
  const std::vector<std::pair<std::string, std::string>> files{
      {"scan.ply", ply_of(view.cloud)}, {"scan.pcd", pcd_of(test::organized())}, {"depth.png", depth}};
  for (const auto& [name, bytes] : files) {
    for (const double share : {0.0, 0.001, 0.5, 0.99}) {
      write(name, bytes.substr(0, static_cast<std::size_t>(share * static_cast<double>(bytes.size()))));
      const ProgramResult run = model(name, "--frame camera");
      EXPECT_EQ(run.status, 2) << name << " " << share;
      EXPECT_THAT(run.err, HasSubstr(name)) << share;
    }
  }
  EXPECT_FALSE(is_labelled());
}

TEST_F(MistakeInModel, OfAFileThatIsNoScanIsRefused) {
  write_scene_of(test::right_view().scene);
  for (const std::string name : {"scene.toml", "tubes.txt"}) {
    write("tubes.txt", "0\n");
    const ProgramResult run = model(name);
    EXPECT_EQ(run.status, 2) << name;
    EXPECT_THAT(run.err, HasSubstr(name));
  }
  EXPECT_FALSE(is_labelled());
}

TEST_F(MistakeInModel, ABinToLocateThatIsNotInTheCloudIsRefused) {
  View view = test::right_view();
  view.scene.support.bin.length = 0.4;
  write("scan.ply", ply_of(view.cloud));
  write_scene_of(view.scene);
  const ProgramResult run = model("scan.ply", "--locate");
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, HasSubstr("support: not located: "));
  EXPECT_FALSE(is_labelled());
}

// Nothing is read from a cloud's labels, nor from its colours, of labels or of a camera.
TEST_F(MistakeInModel, OfTakingColoursForLabelsIsNotMade) {
  const View view = test::right_view();
  ASSERT_EQ(model(view).status, 0);
  const std::vector<int> right = labels();
  PointCloud blue = view.cloud;
  blue.labels.assign(blue.points.size(), 1);
  blue.colors.assign(blue.points.size(), {0, 0, 255});
  for (const PointCloud& coloured : {view.cloud, blue}) {
    write("scan.ply", ply_of(coloured));
    EXPECT_EQ(model("scan.ply").err, "");
    EXPECT_EQ(labels(), right);
  }
}

}  // namespace
}  // namespace tanglebin
