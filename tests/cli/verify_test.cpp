#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "tanglebin/runs/journal.hpp"
#include "tests/support/program.hpp"
#include "tests/support/recipe_text.hpp"

namespace tanglebin {
namespace {

using test::bytes_of;
using test::files_below;
using test::ProgramResult;
using test::run_program;
using test::run_shell;
using test::TemporaryDirectory;
using test::write_bytes;
using testing::HasSubstr;
using testing::StartsWith;

class Verify : public testing::Test {
protected:
  static inline const std::string recipe =
      test::recipe_text({.seed = 3, .width = 96, .tubes = "[2]", .cases = 3});

  Verify() { run_program("generate - --out " + path("dataset"), recipe); }
  std::string path(const std::string& name) const { return (directory_ / name).string(); }
  ProgramResult verify(const std::string& options = {}) const {
    return run_program("verify " + path("dataset") + " " + options);
  }

  TemporaryDirectory directory_;
};

TEST_F(Verify, EndsWithZeroWhereNothingIsWrong) {
  for (const std::string options : {"", "--rest", "--jobs 1", "--repair"}) {
    const ProgramResult result = verify(options);
    EXPECT_EQ(result.status, 0) << result.out;
    EXPECT_THAT(result.out, HasSubstr("dataset: 3 of the recipe's 3 cases, digest "));
    EXPECT_THAT(result.out, HasSubstr("; no faults found\n"));
    EXPECT_EQ(result.err, "");
  }
}

TEST_F(Verify, EndsWithFourAndAListOtherwiseAndRepairs) {
  const auto whole = nlohmann::json::parse(verify("--json").out);
  write_bytes(path("dataset/A2/plys/2.ply"), "ply");
  std::filesystem::remove(path("dataset/A2/gazebo_worlds/3.world"));
  const ProgramResult broken = verify();
  EXPECT_EQ(broken.status, 4);
  EXPECT_THAT(broken.out, StartsWith("A2/gazebo_worlds/3.world: cannot be opened: No such file or directory\n"
                                     "A2/plys/2.ply: bytes: found 3, expected "));
  EXPECT_THAT(broken.out, HasSubstr("; 2 faults found\n"));

  const auto json = nlohmann::json::parse(verify("--json").out);
  EXPECT_EQ(json["faults"].size(), 2U);
  EXPECT_EQ(json["faults"][1]["where"], "A2/plys/2.ply");

  const ProgramResult repaired = verify("--repair");
  EXPECT_EQ(repaired.status, 0) << repaired.out;
  EXPECT_THAT(repaired.out, HasSubstr("2 cases regenerated, no faults found\n"));
  EXPECT_EQ(nlohmann::json::parse(verify("--json").out)["digest"], whole["digest"]);
}

// It may be somebody's, so the dataset stays as it is.
TEST_F(Verify, DoesNotRepairWhereADirectoryIsInTheWayOfAFile) {
  std::filesystem::remove(path("dataset/A2/gazebo_worlds/1.world"));
  for (const std::string file : {"dataset/A2/plys/2.ply", "dataset/dataset.json"}) {
    const std::string bytes = bytes_of(path(file));
    std::filesystem::remove(path(file));
    std::filesystem::create_directory(path(file));
    write_bytes(path(file) + "/notes.txt", "of somebody");
    const auto before = files_below(path("dataset"));
    const ProgramResult result = verify("--repair");
    EXPECT_EQ(result.status, 2);
    EXPECT_EQ(result.err, "tanglebin: " + path(file) + ": found a directory, expected a file or nothing\n");
    EXPECT_EQ(files_below(path("dataset")), before);
    std::filesystem::remove_all(path(file));
    write_bytes(path(file), bytes);
  }
  EXPECT_THAT(verify("--repair").out, HasSubstr("1 case regenerated, no faults found\n"));
}

TEST_F(Verify, DoesNotRepairWhereAFileIsInTheWayOfAFolder) {
  std::filesystem::remove_all(path("dataset/A2/plys"));
  write_bytes(path("dataset/A2/plys"), "of somebody");
  const auto before = files_below(path("dataset"));
  const ProgramResult result = verify("--repair");
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(result.err, "tanglebin: " + path("dataset/A2/plys") + ": found a file, expected a directory\n");
  EXPECT_EQ(files_below(path("dataset")), before);
}

TEST_F(Verify, ReplacesALinkButNotTheDirectoryThatItLeadsTo) {
  std::filesystem::remove(path("dataset/A2/plys/2.ply"));
  std::filesystem::create_directory(path("elsewhere"));
  write_bytes(path("elsewhere/notes.txt"), "of somebody");
  std::filesystem::create_directory_symlink(path("elsewhere"), path("dataset/A2/plys/2.ply"));
  EXPECT_EQ(verify("--repair").status, 0);
  EXPECT_TRUE(
      std::filesystem::is_regular_file(std::filesystem::symlink_status(path("dataset/A2/plys/2.ply"))));
  EXPECT_EQ(bytes_of(path("elsewhere/notes.txt")), "of somebody");
}

TEST_F(Verify, SaysAfterARepairWhatIsStillWrong) {
  write_bytes(path("dataset/A2/plys/77.ply"), "of nobody");
  const ProgramResult result = verify("--repair");
  EXPECT_EQ(result.status, 4);
  EXPECT_THAT(result.out, StartsWith("A2/plys/77.ply: not in the manifest\n"));
}

TEST_F(Verify, AControlFileThatIsNoFileOrNestedTooDeepIsToldOf) {
  std::filesystem::remove(path("dataset/dataset.json"));
  ASSERT_EQ(run_shell("mkfifo " + path("dataset/dataset.json")).status, 0);
  const ProgramResult pipe = verify();
  EXPECT_EQ(pipe.status, 4);
  EXPECT_THAT(pipe.out, StartsWith("dataset.json: found a pipe, expected a regular file\n"));

  std::filesystem::remove(path("dataset/dataset.json"));
  write_bytes(path("dataset/dataset.json"),
              "{\"digest\":" + std::string(400000, '[') + std::string(400000, ']') + "}");
  const ProgramResult deep = verify();
  EXPECT_EQ(deep.status, 4);
  EXPECT_THAT(deep.out, StartsWith("dataset.json: found JSON nested too deep, expected at most 64 levels\n"));

  std::filesystem::remove(path("dataset/recipe.toml"));
  std::filesystem::create_symlink("/dev/zero", path("dataset/recipe.toml"));
  const ProgramResult device = verify();
  EXPECT_EQ(device.status, 2);
  EXPECT_THAT(device.err, HasSubstr("recipe.toml: found a device, expected a regular file"));
}

TEST_F(Verify, NamesOfFilesArePrintedWithoutControlCharacters) {
  write_bytes(path("dataset/A2/plys/\x1b[2Jnew\nline"), "of nobody");
  EXPECT_THAT(verify().out, StartsWith("A2/plys/\\x1b[2Jnew\\nline: not in the manifest\n"));
  const std::string name = "$(printf '/no\\033[31m\\nne')";
  const ProgramResult missing = run_program("verify \"" + name + "\"");
  EXPECT_EQ(
      missing.err,
      "tanglebin: /no\\x1b[31m\\nne: found nothing, expected the directory of a dataset from `tanglebin "
      "generate`\n");
  EXPECT_THAT(run_program("verify \"" + name + "\" --\"" + name + "\"").err, testing::Not(HasSubstr("\x1b")));
}

TEST_F(Verify, OfAPartCanBeOfTheCasesThatItHas) {
  ASSERT_EQ(run_program("generate - --cases 2 --out " + path("part"), recipe).status, 0);
  const ProgramResult all = run_program("verify " + path("part"));
  EXPECT_EQ(all.status, 4);
  EXPECT_THAT(all.out, StartsWith("missing: 2 of 3 cases: A2/1, A2/3\n"));
  EXPECT_EQ(run_program("verify --cases 2 " + path("part")).status, 0);
  EXPECT_EQ(run_program("verify --cases 2-3 " + path("part")).status, 4);
  EXPECT_EQ(run_program("verify --cases 4 " + path("part")).status, 2);
}

TEST_F(Verify, SaysThatARunIsInProgressAndDoesNotRepairBesideIt) {
  const Journal running(path("dataset"), "2-of-3");
  const ProgramResult result = verify();
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.out, StartsWith("journal-2-of-3.jsonl: a run is in progress; "));
  EXPECT_EQ(nlohmann::json::parse(verify("--json").out)["notes"].size(), 1U);
  const ProgramResult repair = verify("--repair");
  EXPECT_EQ(repair.status, 2);
  EXPECT_EQ(repair.err, "tanglebin: " + path("dataset") +
                            ": a run is in progress; repair the dataset when it has ended\n");
}

TEST_F(Verify, BadInputIsExitStatusTwo) {
  EXPECT_EQ(run_program("verify " + path("none")).status, 2);
  EXPECT_EQ(run_program("verify").status, 64);
}

TEST_F(Verify, HelpHasAnExample) {
  EXPECT_THAT(run_program("verify --help").out, HasSubstr("tanglebin verify dataset --repair"));
}

}  // namespace
}  // namespace tanglebin
