#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "tanglebin/io/ply.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_directory.hpp"

namespace tanglebin {
namespace {

namespace fs = std::filesystem;
using test::bytes_of;
using test::ProgramResult;
using test::write_bytes;

// Coarse clouds, so that they are quick to make.
// The page's one block of code in a language.
std::string block_of(const std::string& language) {
  const std::string page = bytes_of(fs::path(TANGLEBIN_SOURCE) / "docs" / "scoring.md");
  const std::string opening = "\n```" + language + "\n";
  const std::size_t begin = page.find(opening);
  if (begin == std::string::npos) return {};
  const std::size_t code = begin + opening.size();
  return page.substr(code, page.find("```", code) - code);
}

// A directory with a dataset of two clouds and the page's Python program.
class ScoringPage : public testing::Test {
protected:
  static constexpr const char* recipe = R"(
seed = 3

[scanner]
width = 240
height = 150

[[set]]
name = "A"
tubes = [1, 3]
cases = 1

[set.tube]
length = 0.5
radius = 0.0125
mass = 0.5
bend_max_deg = 30
)";

  ScoringPage() {
    write_bytes(directory_ / "recipe.toml", recipe);
    write_bytes(directory_ / "label.py", block_of("python"));
    const ProgramResult generated = run("tanglebin generate recipe.toml --out dataset");
    EXPECT_EQ(generated.status, 0) << generated.err;
  }

  // Runs a command in the directory. Debian's python3 goes first: it is the one that python3-numpy is for.
  ProgramResult run(const std::string& command) const {
    const std::string program = fs::path(TANGLEBIN_PROGRAM).parent_path().string();
    return test::run_shell("cd " + directory_.path().string() + " && export PATH=" + program +
                           ":/usr/bin:/bin && " + command);
  }

  fs::path path(const std::string& name) const { return directory_ / name; }

private:
  test::TemporaryDirectory directory_;
};

// Micro-recall of one label for all points: the share of the tube with the most.
double share_of_largest_tube(const PointCloud& cloud) {
  std::map<std::int32_t, double> points;
  double on_tubes = 0;
  double most = 0;
  for (const std::int32_t label : cloud.labels) {
    if (label < 1) continue;
    ++on_tubes;
    most = std::max(most, ++points[label]);
  }
  return most / on_tubes;
}

TEST_F(ScoringPage, ItsPythonKeepsThePointsAndWritesLabels) {
  const ProgramResult labelled = run("python3 label.py dataset/A3/plys/1.ply labelled.ply");
  ASSERT_EQ(labelled.status, 0) << labelled.err;
  const PointCloud truth = read_ply(path("dataset/A3/plys/1.ply"));
  const PointCloud cloud = read_ply(path("labelled.ply"));
  EXPECT_EQ(cloud.points, truth.points);
  EXPECT_EQ(cloud.labels, std::vector<std::int32_t>(truth.points.size(), 1));
}

TEST_F(ScoringPage, ItsLoopPrintsTheMeanMicroRecallOfADataset) {
  write_bytes(path("loop.sh"), block_of("bash"));
  const ProgramResult loop = run("bash -e loop.sh");
  ASSERT_EQ(loop.status, 0) << loop.err;
  // All points of the one tube are right, and those of the largest of three.
  const double of_three = share_of_largest_tube(read_ply(path("dataset/A3/plys/1.ply")));
  EXPECT_LT(of_three, 0.9);
  EXPECT_NEAR(std::stod(loop.out), (1 + of_three) / 2, 1e-12);
  const std::string scores = bytes_of(path("scores.jsonl"));
  EXPECT_EQ(std::ranges::count(scores, '\n'), 2);
}

TEST_F(ScoringPage, ItsSnippetsAreShort) {
  for (const std::string language : {"python", "bash"}) {
    const std::string code = block_of(language);
    EXPECT_NE(code, "") << language;
    EXPECT_LE(std::ranges::count(code, '\n'), 10) << language;
  }
}

}  // namespace
}  // namespace tanglebin
