#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/program.hpp"
#include "tests/support/recipe_text.hpp"
#include "tests/support/temporary_directory.hpp"

namespace tanglebin {
namespace {

using nlohmann::json;
using test::ProgramResult;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

/// A dataset of one scene of two tubes, which takes a moment to make.
class ViewCommand : public testing::Test {
protected:
  static void SetUpTestSuite() {
    directory_ = std::make_unique<test::TemporaryDirectory>();
    test::write_bytes(*directory_ / "recipe.toml",
                      test::recipe_text({.seed = 3, .width = 480, .tubes = "[2]", .cases = 1}));
    const ProgramResult made = run("generate recipe.toml --out dataset");
    ASSERT_EQ(made.status, 0) << made.err;
    const ProgramResult modelled =
        run("model dataset/A2/plys/1.ply --scene dataset --out labelled.ply --modelled-tubes tubes.txt");
    ASSERT_EQ(modelled.status, 0) << modelled.err;
  }

  static void TearDownTestSuite() { directory_.reset(); }

  static ProgramResult run(const std::string& arguments) {
    return test::run_shell("cd " + directory_->path().string() + " && " + TANGLEBIN_PROGRAM + " " +
                           arguments);
  }

  /// The scene on the page that `tanglebin view` writes with these arguments.
  static json viewed(const std::string& arguments) {
    const ProgramResult made = run("view " + arguments + " --out scene.html");
    EXPECT_EQ(made.status, 0) << made.err;
    EXPECT_EQ(made.out + made.err, "");
    const std::string page = test::bytes_of(*directory_ / "scene.html");
    EXPECT_THAT(page, StartsWith("<!DOCTYPE html>"));
    const std::string opening = "<script type=\"application/json\">";
    const std::size_t begin = page.find(opening) + opening.size();
    return json::parse(page.substr(begin, page.find("</script>", begin) - begin));
  }

  static std::vector<std::string> names(const json& scene) {
    std::vector<std::string> result;
    for (const json& labelling : scene.at("labellings")) result.push_back(labelling.at("name"));
    return result;
  }

private:
  static std::unique_ptr<test::TemporaryDirectory> directory_;
};

std::unique_ptr<test::TemporaryDirectory> ViewCommand::directory_;

TEST_F(ViewCommand, ShowsADatasetsCaseWithItsTruthInItsBin) {
  const json scene = viewed("dataset/A2/1");
  EXPECT_EQ(scene.at("name"), "A2/1");
  EXPECT_THAT(names(scene), ElementsAre("truth"));
  EXPECT_EQ(scene.at("labellings")[0].at("tubes").size(), 2U);
  EXPECT_EQ(scene.at("bin").size(), 8U);
  EXPECT_GT(scene.at("points").at("of"), 100);
}

TEST_F(ViewCommand, ComparesWhatWasFoundWithTheTruth) {
  const json scene = viewed("dataset/A2/1 --labelled labelled.ply --modelled-tubes tubes.txt");
  EXPECT_THAT(names(scene), ElementsAre("truth", "found"));
  EXPECT_GT(scene.at("labellings")[1].at("score").at("micro_recall"), 0.9);
  EXPECT_EQ(scene.at("labellings")[1].at("tubes").size(), 2U);
  const json from_files = viewed(
      "dataset/A2/plys/1.ply --true-tubes dataset/A2/tube_configurations/1.txt --labelled labelled.ply "
      "--modelled-tubes tubes.txt --scene dataset");
  EXPECT_EQ(from_files.at("labellings"), scene.at("labellings"));
  EXPECT_EQ(from_files.at("bin"), scene.at("bin"));
}

TEST_F(ViewCommand, ShowsALabelledCloudWithTheTubesThatWereFound) {
  const json scene = viewed("labelled.ply --modelled-tubes tubes.txt");
  EXPECT_FALSE(scene.at("has_truth"));
  EXPECT_THAT(names(scene), ElementsAre("labels"));
  EXPECT_TRUE(scene.at("labellings")[0].at("score").is_null());
  EXPECT_EQ(scene.at("labellings")[0].at("tubes").size(), 2U);
  json piped = viewed("- --modelled-tubes tubes.txt < labelled.ply");
  piped["name"] = scene.at("name");
  EXPECT_EQ(piped, scene);
}

TEST_F(ViewCommand, ShowsAConfigurationsTubes) {
  const json scene = viewed("dataset/A2/tube_configurations/1.txt --scene dataset");
  EXPECT_EQ(scene.at("points").at("count"), 0);
  EXPECT_THAT(names(scene), ElementsAre("tubes"));
  EXPECT_EQ(scene.at("bin").size(), 8U);
}

TEST_F(ViewCommand, ShowsTheTubesOfTubesJson) {
  const ProgramResult modelled = run(
      "model dataset/A2/plys/1.ply --scene dataset --out - --modelled-tubes tubes.json > labelled-again.ply");
  ASSERT_EQ(modelled.status, 0) << modelled.err;
  const json scene = viewed("tubes.json");
  EXPECT_THAT(names(scene), ElementsAre("tubes"));
  EXPECT_EQ(scene.at("labellings")[0].at("tubes"), viewed("tubes.txt").at("labellings")[0].at("tubes"));
  EXPECT_EQ(viewed("dataset/A2/1 --labelled labelled.ply --modelled-tubes tubes.json"),
            viewed("dataset/A2/1 --labelled labelled.ply --modelled-tubes tubes.txt"));
  EXPECT_EQ(run("score --truth dataset/A2/plys/1.ply --labelled labelled.ply --true-tubes "
                "dataset/A2/tube_configurations/1.txt --modelled-tubes tubes.json")
                .out,
            run("score --truth dataset/A2/plys/1.ply --labelled labelled.ply --true-tubes "
                "dataset/A2/tube_configurations/1.txt --modelled-tubes tubes.txt")
                .out);
}

TEST_F(ViewCommand, SaysWhatIsWrongWithItsInputAndExitsWith2) {
  const auto message = [&](const std::string& arguments) {
    const ProgramResult made = run("view " + arguments);
    EXPECT_EQ(made.status, 2) << arguments;
    return made.err;
  };
  EXPECT_THAT(message("dataset/A2/7 --out a.html"),
              HasSubstr("found 'A2/7', expected a case of the dataset, such as A2/1"));
  EXPECT_THAT(message("absent.ply --out a.html"), HasSubstr("absent.ply: cannot be opened"));
  EXPECT_THAT(message("dataset/A2/1 --out a.png"), HasSubstr("--out: found 'a.png'"));
  EXPECT_THAT(message("dataset/A2/tube_configurations/1.txt --labelled labelled.ply --out a.html"),
              HasSubstr("--labelled: found tubes to view"));
  EXPECT_THAT(message("dataset/A2/1 --modelled-tubes recipe.toml --out a.html"), HasSubstr("recipe.toml:1"));
}

TEST_F(ViewCommand, HelpHasAnExample) {
  EXPECT_THAT(run("view --help").out, HasSubstr("tanglebin view dataset/"));
}

}  // namespace
}  // namespace tanglebin
