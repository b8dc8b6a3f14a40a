#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "tanglebin/io/read_cloud.hpp"
#include "tanglebin/score/score.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_directory.hpp"

namespace tanglebin {
namespace {

using test::ProgramResult;
using testing::HasSubstr;

/// A dataset that two scanners see, one from above and one aslant.
class CaseOfTwoScanners : public testing::Test {
protected:
  static void SetUpTestSuite() {
    directory_ = std::make_unique<test::TemporaryDirectory>();
    test::write_bytes(*directory_ / "recipe.toml", R"(
seed = 3
[[scanner]]
name = "above"
width = 480
height = 300
[[scanner]]
name = "aslant"
width = 480
height = 300
distance = 2.0
look_at = [0, 0, 0]
tilt_deg = 40
sigma = 0.0005
[[set]]
name = "A"
tubes = [2]
cases = 1
[set.tube]
radius = 0.0125
mass = 0.5
length = 0.5
bend_max_deg = 30
)");
    const ProgramResult made = run("generate recipe.toml --out dataset");
    ASSERT_EQ(made.status, 0) << made.err;
  }

  static void TearDownTestSuite() { directory_.reset(); }

  static ProgramResult run(const std::string& arguments) {
    return test::run_shell("cd " + directory_->path().string() + " && " + TANGLEBIN_PROGRAM + " " +
                           arguments);
  }

  static std::string complaint(const std::string& arguments) {
    const ProgramResult result = run(arguments);
    EXPECT_EQ(result.status, 2) << arguments;
    return result.err;
  }

  static double recall_of(const std::string& scene) {
    const ProgramResult modelled =
        run("model dataset/A2/aslant/plys/1.ply --scene " + scene + " --out out.ply");
    EXPECT_EQ(modelled.status, 0) << modelled.err;
    const auto labels = [](const std::string& file) {
      return read_cloud(std::filesystem::path(*directory_ / file)).labels;
    };
    return score(labels("dataset/A2/aslant/plys/1.ply"), labels("out.ply")).micro_recall;
  }

  static std::string bytes_of(const std::string& file) { return test::bytes_of(*directory_ / file); }

  static constexpr const char* both = "dataset/A2/above/1 or dataset/A2/aslant/1";

  static std::unique_ptr<test::TemporaryDirectory> directory_;
};

std::unique_ptr<test::TemporaryDirectory> CaseOfTwoScanners::directory_;

TEST_F(CaseOfTwoScanners, IsModelledWithTheCameraThatSawIt) {
  EXPECT_GT(recall_of("dataset"), 0.9);
  EXPECT_EQ(recall_of("dataset/A2/aslant/1"), recall_of("dataset"));
}

TEST_F(CaseOfTwoScanners, HasNoCameraUnlessAScannerIsNamed) {
  const std::string model = "model dataset/A2/aslant/plys/1.ply --out out.ply --scene ";
  EXPECT_THAT(complaint(model + "dataset/A2/1"), HasSubstr("scanner: found the 2 scanners of A2/1"));
  EXPECT_THAT(complaint(model + "dataset/A2/1"), HasSubstr(both));
  EXPECT_THAT(complaint(model + "dataset/A2/left/1"), HasSubstr("scanner: found 'left'"));
  EXPECT_THAT(complaint(model + "dataset/A2/left/1"), HasSubstr(both));
  EXPECT_THAT(complaint(model + "recipe.toml"), HasSubstr("recipe.toml: scanner: found 2 scanners"));
  EXPECT_THAT(complaint("scan dataset/A2/tube_configurations/1.txt --out out.ply --scene dataset"),
              HasSubstr(both));
  EXPECT_THAT(complaint("view dataset/A2/1 --out out.html"), HasSubstr(both));
}

TEST_F(CaseOfTwoScanners, IsShownAsOneOfThemSeesIt) {
  ASSERT_EQ(run("view dataset/A2/aslant/1 --out aslant.html").status, 0);
  EXPECT_THAT(bytes_of("aslant.html"), HasSubstr("A2/1, aslant"));
}

TEST_F(CaseOfTwoScanners, IsScannedAgainByTheScannerThatSawIt) {
  const std::string manifest = bytes_of("dataset/manifest.jsonl");
  const auto seed = nlohmann::json::parse(manifest.substr(0, manifest.find('\n')))["seed"].get<std::string>();
  const std::string scan =
      "scan dataset/A2/tube_configurations/1.txt --with-bin --out again.ply --seed 0x" + seed;
  const auto cloud_of = [&](const std::string& options) {
    EXPECT_EQ(run(scan + options).status, 0);
    return bytes_of("again.ply");
  };
  const std::string aslant = " --scene dataset/A2/aslant/1";
  EXPECT_TRUE(cloud_of(aslant) == bytes_of("dataset/A2/aslant/plys/1.ply"));
  EXPECT_TRUE(cloud_of(aslant + "/") == bytes_of("dataset/A2/aslant/plys/1.ply"));
  EXPECT_THAT(complaint(scan + " --scene nowhere"), HasSubstr("--scene: found nothing called 'nowhere'"));
  const std::string ideal = cloud_of(aslant + " --parameter scanner.sigma=0");
  EXPECT_FALSE(ideal == bytes_of("dataset/A2/aslant/plys/1.ply"));
  EXPECT_TRUE(ideal == cloud_of(aslant + " --scanner paper")) << "the camera is the scene's";
}

// An output may lead to a dataset's file by a link, and the camera of --depth is beside its image.
TEST_F(CaseOfTwoScanners, IsNotOverwrittenByWhatIsMadeOfIt) {
  const std::map<std::string, std::string> before = test::files_below(*directory_ / "dataset");
  for (const std::string link : {"link.html", "link.png", "link.txt"})
    std::filesystem::create_symlink("dataset/manifest.jsonl", *directory_ / link);
  const std::string tubes = " dataset/A2/tube_configurations/1.txt ";
  const std::string cloud = " dataset/A2/above/plys/1.ply ";
  for (const std::string scene : {"dataset", "dataset/", "dataset/A2/above/1"}) {
    for (const std::string& command : {
             "locate" + cloud + "--out dataset/recipe.toml",
             "model" + cloud + "--out out.ply --modelled-tubes dataset/dataset.json",
             "model" + cloud + "--out out.ply --modelled-tubes link.txt",
             "scan" + tubes + "--out out.ply --depth dataset/dataset.png",
             "view" + tubes + "--out link.html",
             "preview" + tubes + "--out link.png",
         })
      EXPECT_THAT(complaint(command + " --scene " + scene), HasSubstr("which is also an input"));
  }
  EXPECT_EQ(test::files_below(*directory_ / "dataset"), before);
}

TEST_F(CaseOfTwoScanners, HasOneBinWhoeverLooks) {
  for (const std::string scene : {"dataset", "dataset/A2/1", "dataset/A2/above/1", "recipe.toml"}) {
    const ProgramResult drawn =
        run("preview dataset/A2/tube_configurations/1.txt --out " + std::string("out.png --scene ") + scene);
    EXPECT_EQ(drawn.status, 0) << scene << ": " << drawn.err;
  }
}

}  // namespace
}  // namespace tanglebin
