#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>

#include "tests/support/program.hpp"

namespace tanglebin {
namespace {

using test::bytes_of;
using test::files_below;
using test::run_program;
using test::run_shell;
using test::TemporaryDirectory;
using test::write_bytes;
using testing::HasSubstr;
using testing::StartsWith;

// Two sets of few tubes and a coarse camera, so that a case is quick.
class Generate : public testing::Test {
protected:
  static constexpr const char* recipe = R"(
seed = 3
[scanner]
width = 192
height = 120
[[set]]
name = "A"
tubes = [1, 2]
cases = 3
[set.tube]
radius = 0.0125
mass = 0.5
length = 0.5
bend_max_deg = 30
[[set]]
name = "B"
tubes = [1]
cases = 3
[set.tube]
radius = 0.0125
mass = 0.5
length = 0.5
bend_max_deg = 45
)";

  Generate() { write_bytes(recipe_, recipe); }

  std::string out(const std::string& name = "dataset") const { return (directory_ / name).string(); }
  std::string command(const std::string& more = {}, const std::string& name = "dataset") const {
    return "generate " + recipe_.string() + " --out " + out(name) + " " + more;
  }

  // Runs the program with these variables.
  static test::ProgramResult run_in(const std::string& environment, const std::string& arguments) {
    return run_shell(environment + " " + TANGLEBIN_PROGRAM + " " + arguments);
  }
  static constexpr const char* slurm_task_2_of_4 =
      "SLURM_ARRAY_TASK_ID=2 SLURM_ARRAY_TASK_COUNT=4 SLURM_ARRAY_TASK_MIN=1";

  TemporaryDirectory directory_;
  std::filesystem::path recipe_ = directory_ / "recipe.toml";
};

TEST_F(Generate, MakesTheRecipesCasesAndSaysSo) {
  const auto result = run_program(command());
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.out, HasSubstr("dataset: 9 cases generated in "));
  EXPECT_EQ(result.err, "");  // no progress where standard error is no terminal
  EXPECT_EQ(files_below(out()).size(), 9 * 3 + 5U);
}

TEST_F(Generate, ADryRunWritesNothingAndSaysWhatToExpect) {
  const auto result = run_program("generate " + recipe_.string() + " --dry-run --jobs 2");
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.err, "");
  EXPECT_THAT(result.out,
              testing::ContainsRegex("^set A: 6 cases, about .* of one processor's time and .* MB\n"
                                     "set B: 3 cases, .*\nin all: 9 cases, about .* with --jobs 2 and "));
  EXPECT_THAT(result.out,
              HasSubstr("warning: scanner: a tube of set A on the floor is only 1.7 pixels across"));
  EXPECT_EQ(files_below(directory_.path()).size(), 1U) << "only the recipe";
}

TEST_F(Generate, ADryRunTriesACaseNoLongerThanARunWould) {
  const auto result = run_program("generate " + recipe_.string() + " --dry-run --case-limit 0.001");
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("tubes after 0.001 s, when a dry run gives up"));
}

TEST_F(Generate, ADryRunShowsTheFirstCase) {
  const auto result =
      run_program("generate " + recipe_.string() + " --dry-run --json --set B --picture " + out("b.png"));
  EXPECT_EQ(result.status, 0);
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json["cases"], 3);
  EXPECT_EQ(json["sets"]["B"]["cases"], 3);
  EXPECT_GT(json["bytes"], 1000);
  EXPECT_GT(json["processor_seconds"], 0);
  EXPECT_EQ(json["warnings"].size(), 1U) << "few pixels, of set B alone";
  EXPECT_THAT(bytes_of(directory_ / "b.png"), StartsWith("\x89PNG"));
}

TEST_F(Generate, ADryRunsPictureHasStandardOutputToItself) {
  const auto result = run_program("generate " + recipe_.string() + " --dry-run --set B --picture -");
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.out, StartsWith("\x89PNG"));
  EXPECT_THAT(result.err, HasSubstr("warning: scanner: a tube of set B"));
}

TEST_F(Generate, RefusesWhatItCannotUseBeforeItBegins) {
  const auto picture = run_program("generate " + recipe_.string() + " --dry-run --picture b.jpg");
  EXPECT_EQ(picture.status, 2);
  EXPECT_EQ(picture.err, "tanglebin: --picture: found 'b.jpg', expected a name that ends in .png\n");
  for (const std::string limit : {"0", "nan", "1e10", "soon"}) {
    const auto result = run_program(command("--case-limit " + limit));
    EXPECT_EQ(result.status, 64) << limit;
    EXPECT_THAT(result.err, HasSubstr("expected a number from 0.001 to 1000000000")) << limit;
  }
}

// What a dataset is refused for, a dry run is too.
TEST_F(Generate, RefusesTheSameWithAndWithoutADryRun) {
  const auto said = [&](const std::string& scanner, const std::string& options) {
    std::ofstream(recipe_)
        << "[output]\ndepths = true\n[scanner]\nwidth = 64\nheight = 40\n"
        << scanner
        << "\n[[set]]\nname = \"A\"\ntubes = [1]\n[set.tube]\nradius = 0.0125\nmass = 0.5\n"
           "length = 0.3\nbend_max_deg = 30\n";
    const auto result = run_program("generate " + recipe_.string() + options);
    EXPECT_EQ(result.status, 2) << scanner << options;
    return result.err;
  };
  for (const std::string& options : {std::string(" --dry-run"), " --out " + out()}) {
    EXPECT_THAT(said("hfov_deg = 2", options),
                HasSubstr("scanner: found a horizontal field of view of 0.0349"));
    EXPECT_THAT(
        said("look_at = [0, 0, 0]\ndistance = 8", options),
        HasSubstr("scanner.position: found the bin 7.6 m from the camera, expected at most 6.5535 m, the "
                  "largest depth in a depth image; or switch depths off"));
    EXPECT_THAT(said("position = [3, 0, 1]\nlook_at = [5, 0, 3]", options),
                HasSubstr("expected one that has the bin in its view"));
  }
}

TEST_F(Generate, ADryRunNamesAnOutputThatTheRunWouldNot) {
  const auto said = [&](const std::string& place) {
    std::string messages;
    for (const char* const dry : {" --dry-run", ""}) {
      const auto result = run_program("generate " + recipe_.string() + dry + " --out " + place);
      EXPECT_EQ(result.status, 2) << place << dry;
      EXPECT_EQ(messages.empty() ? result.err : messages, result.err);
      messages = result.err;
    }
    return messages;
  };
  std::filesystem::create_directory(directory_ / "results");
  write_bytes(directory_ / "results/experiment.json", "{}");
  EXPECT_THAT(said(out("results")), HasSubstr("found the results of an experiment, expected a dataset or"));
  EXPECT_THAT(said(recipe_.string() + "/dataset"), HasSubstr("recipe.toml: found a file, expected a direct"));
  EXPECT_EQ(files_below(directory_.path()).size(), 2U);
}

TEST_F(Generate, NeedsADirectoryUnlessItIsADryRun) {
  const auto without = run_program("generate " + recipe_.string());
  EXPECT_EQ(without.status, 64);
  EXPECT_THAT(without.err, HasSubstr("--out is required"));
  const auto picture = run_program("generate " + recipe_.string() + " --out " + out() + " --picture a.png");
  EXPECT_EQ(picture.status, 64);
  EXPECT_THAT(picture.err, HasSubstr("--picture requires --dry-run"));
}

TEST_F(Generate, MakesOnlyTheCasesAskedForAndGoesOnLater) {
  const auto first = run_program(command("--set A --tubes 2 --cases 2-3 --json"));
  EXPECT_EQ(first.status, 0);
  const auto json = nlohmann::json::parse(first.out);
  EXPECT_EQ(json["made"], 2);
  EXPECT_EQ(json["complete"], true);
  EXPECT_TRUE(std::filesystem::exists(directory_ / "dataset/A2/plys/3.ply"));
  EXPECT_FALSE(std::filesystem::exists(directory_ / "dataset/A2/plys/1.ply"));

  const auto second = nlohmann::json::parse(run_program(command("--json")).out);
  EXPECT_EQ(second["found"], 2);
  EXPECT_EQ(second["made"], 7);
}

TEST_F(Generate, ChoosesCasesByListsAndRanges) {
  const auto wanted = [&](const std::string& options) {
    return nlohmann::json::parse(run_program(command("--json " + options)).out)["wanted"].get<int>();
  };
  EXPECT_EQ(wanted("--set B --cases 1,3"), 2);
  EXPECT_EQ(wanted("--set A,B --tubes 1-2 --cases 2"), 3);
  EXPECT_EQ(wanted("--set A --set B --tubes 1,7-9"), 6);
  EXPECT_EQ(run_program("generate --tubes 1 --cases 1 " + recipe_.string() + " --out " + out("other")).status,
            0);
}

TEST_F(Generate, TheSeedMayBeHexadecimal) {
  run_program(command("--seed 0x63 --cases 1 --tubes 1"));
  EXPECT_THAT(bytes_of(directory_ / "dataset/recipe.toml"), HasSubstr("\nseed = 99\n"));
  EXPECT_THAT(run_program(command("--seed 0xffffffffffffffff")).err,
              HasSubstr("seed: found 18446744073709551615, expected at most 9223372036854775807"));
}

TEST_F(Generate, ShardsMakeEachCaseOnce) {
  std::size_t made = 0;
  for (const std::string shard : {"1", "2"}) {
    const auto result = run_program(command("--json --shard " + shard + "/2", "part" + shard));
    made += nlohmann::json::parse(result.out)["made"].get<std::size_t>();
  }
  EXPECT_EQ(made, 9U);
  auto first = files_below(out("part1"));
  for (const auto& [name, bytes] : files_below(out("part2"))) {
    const bool is_of_a_case = name.find('/') != std::string::npos;
    EXPECT_FALSE(is_of_a_case && first.contains(name)) << name;
  }
}

TEST_F(Generate, OneJobOrTwoGiveTheSameBytes) {
  run_program(command("--jobs 1", "one"));
  run_program(command("--jobs 2", "two"));
  auto one = files_below(out("one"));
  auto two = files_below(out("two"));
  one.erase("times.jsonl");
  two.erase("times.jsonl");
  EXPECT_EQ(one, two);
}

TEST_F(Generate, PrintsTheDigestThatTheDatasetHas) {
  const auto text = run_program(command());
  const auto json = nlohmann::json::parse(run_program(command("--json")).out);
  const std::string digest = json["dataset"]["digest"];
  EXPECT_THAT(text.out, HasSubstr("dataset: complete, 9 cases, digest " + digest + "\n"));
  EXPECT_EQ(nlohmann::json::parse(bytes_of(directory_ / "dataset/dataset.json"))["digest"], digest);
  const auto part = run_program(command("--cases 1", "part"));
  EXPECT_THAT(part.out, HasSubstr("part: 3 of the recipe's 9 cases, digest "));
}

TEST_F(Generate, AnyShardsInOneDirectoryAreTheRunInOnePiece) {
  run_program(command("", "whole"));
  for (const std::string shard : {"3/3", "1/3", "2/3"}) run_program(command("--shard " + shard, "shared"));
  auto whole = files_below(out("whole"));
  auto shared = files_below(out("shared"));
  whole.erase("times.jsonl");
  shared.erase("times.jsonl");
  EXPECT_EQ(shared, whole);
}

TEST_F(Generate, TakesTheShardFromTheQueuesEnvironmentIfAsked) {
  const auto made = [&](const std::string& environment, const std::string& options, const std::string& name) {
    const auto result = run_in(environment, command("--json " + options, name));
    EXPECT_EQ(result.status, 0);
    EXPECT_EQ(result.err, "");
    return nlohmann::json::parse(result.out)["made"].get<int>();
  };
  EXPECT_EQ(made(slurm_task_2_of_4, "--shard auto", "slurm"), 2);
  EXPECT_EQ(made("JOB_COMPLETION_INDEX=0 JOB_COMPLETIONS=4", "--shard auto", "kubernetes"), 3);
  EXPECT_EQ(made(slurm_task_2_of_4, "--shard 1/1", "all"), 9);
  const auto wrong = run_in("JOB_COMPLETION_INDEX=0", command("--shard auto"));
  EXPECT_EQ(wrong.status, 2);
  EXPECT_THAT(wrong.err, HasSubstr("JOB_COMPLETIONS: not set"));
}

TEST_F(Generate, MakesAllCasesInAnArrayOverSomethingElseAndSaysSo) {
  const auto one_of_many = run_in(slurm_task_2_of_4, command("--json"));
  EXPECT_EQ(one_of_many.status, 0);
  EXPECT_EQ(nlohmann::json::parse(one_of_many.out)["made"], 9);
  EXPECT_EQ(one_of_many.err,
            "tanglebin: taking all cases, though SLURM_ARRAY_TASK_ID is set; --shard auto takes only this "
            "task's part\n");
  // Numbers that define no shards, as in --array=1,3,7, are no business of such a run.
  EXPECT_EQ(run_in("SLURM_ARRAY_TASK_ID=7", command()).status, 0);
}

TEST_F(Generate, OutsideOfAnArrayThereIsNoShardToFind) {
  const auto result = run_program(command("--shard auto"));
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(
      result.err,
      "tanglebin: --shard: found auto, but neither SLURM_ARRAY_TASK_ID nor JOB_COMPLETION_INDEX is set, "
      "expected a Slurm job array or a Kubernetes indexed job; give I/N elsewhere\n");
}

TEST_F(Generate, TellsAProgramOfEachEventInALineOfJson) {
  const auto result = run_program(command("--progress json"));
  EXPECT_EQ(result.err, "");
  std::istringstream lines(result.out);
  std::map<std::string, int> events;
  nlohmann::json last;
  std::set<std::string> made;
  for (std::string line; std::getline(lines, line);) {
    last = nlohmann::json::parse(line);
    ++events[last["event"]];
    if (last["event"] == "progress") {
      for (const char* key : {"wanted", "found", "made", "failed", "rejected", "rate", "remaining_seconds"}) {
        EXPECT_TRUE(last.contains(key)) << key;
      }
    }
    if (last["event"] == "case") {
      made.insert(last["set"].get<std::string>() + last["tubes"].dump() + "/" + last["case"].dump());
      EXPECT_TRUE(last["seconds"].is_number());
      EXPECT_TRUE(last["rejected"].is_number());
    }
  }
  EXPECT_EQ(events["case"], 9);
  EXPECT_EQ(made.size(), 9U);
  EXPECT_GE(events["progress"], 1);
  EXPECT_EQ(last["event"], "end");
  EXPECT_EQ(last["made"], 9);
  EXPECT_EQ(last["dataset"]["cases"], 9);
}

TEST_F(Generate, CasesWithoutAValidSceneAreToldOfAndTheOthersMade) {
  // In 0.9 s of simulated time one tube comes to rest, twelve do not.
  write_bytes(recipe_,
              "seed = 3\nattempts = 1\n[settle]\ntime_limit = 0.9\n[scanner]\nwidth = 48\nheight = 30\n"
              "[[set]]\nname = 'A'\ntubes = [1, 12]\ncases = 2\n"
              "[set.tube]\nradius = 0.0125\nmass = 0.5\nlength = 0.5\nbend_max_deg = 30\n");
  const auto result = run_program(command("--jobs 1 --progress json"));
  EXPECT_EQ(result.status, 3);
  EXPECT_THAT(
      result.out,
      HasSubstr("{\"event\":\"failure\",\"set\":\"A\",\"tubes\":12,\"case\":1,\"reason\":\"no valid "));
  EXPECT_THAT(result.err, testing::ContainsRegex("^tanglebin: A12/1: failed: no valid scene of 12 tubes in 1 "
                                                 "attempts: .* \\(seed 0x[0-9a-f]{16}\\)\n"
                                                 "tanglebin: A12/2: failed: "));
  EXPECT_EQ(std::ranges::count(bytes_of(directory_ / "dataset/failed.jsonl"), '\n'), 2);
  const auto hopeless = run_program(command("--tubes 12", "hopeless"));
  EXPECT_EQ(hopeless.status, 3);
  EXPECT_THAT(hopeless.err, testing::ContainsRegex(
                                "^tanglebin: A12/[12]: failed: no valid scene of 12 tubes in 1 attempts"));
}

TEST_F(Generate, TheSeedCanBeGivenAndIsInTheResolvedRecipe) {
  run_program(command("--seed 99 --cases 1"));
  EXPECT_THAT(bytes_of(directory_ / "dataset/recipe.toml"), HasSubstr("\nseed = 99\n"));
  const auto other = run_program(command("--cases 1"));
  EXPECT_EQ(other.status, 2);
  EXPECT_THAT(other.err, HasSubstr("belongs to another recipe: seed: it has 99, this one 3"));
}

TEST_F(Generate, TheResolvedRecipeMakesTheSameDataset) {
  run_program(command("--cases 1"));
  EXPECT_EQ(run_program("generate " + out() + "/recipe.toml --cases 1 --out " + out("again")).status, 0);
  auto first = files_below(out());
  auto again = files_below(out("again"));
  first.erase("times.jsonl");
  again.erase("times.jsonl");
  EXPECT_EQ(first, again);
}

TEST_F(Generate, ReadsTheRecipeFromStandardInput) {
  EXPECT_EQ(run_program("generate - --cases 1 --out " + out(), recipe).status, 0);
  const auto result = run_program("generate - --out " + out("b"), "sead = 1");
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, StartsWith("tanglebin: standard input:1: "));
}

TEST_F(Generate, BadInputIsExitStatusTwoAndOneLine) {
  const auto expect_error = [&](const std::string& arguments, const std::string& message) {
    const auto result = run_program(arguments);
    EXPECT_EQ(result.status, 2) << arguments;
    EXPECT_THAT(result.err, HasSubstr(message)) << arguments;
    EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << result.err;
    EXPECT_EQ(result.out, "");
  };
  expect_error("generate " + (directory_ / "none.toml").string() + " --out " + out(), "none.toml: ");
  expect_error(command("--set C"),
               "recipe.toml: no case matches --set, --tubes and --cases; there are set A with 1-2 tubes and "
               "cases 1-3; set B with 1 tubes and cases 1-3");
  expect_error(command("--cases 3-1"),
               "--cases: found '3-1', expected numbers from 1, and ranges, such as 1,5,10-20");
  expect_error(command("--shard 3/2"),
               "--shard: found '3/2', expected I/N with I from 1 to N, such as 2/8, or auto");
  expect_error("generate " + recipe_.string() + " --out /proc/dataset", "/proc/dataset");
  EXPECT_FALSE(std::filesystem::exists(out()));
  std::filesystem::create_directory(out("results"));
  write_bytes(out("results") + "/experiment.json", "{}");
  expect_error(command("", "results"),
               "results: found the results of an experiment, expected a dataset or an empty directory");
}

TEST_F(Generate, ACaseThatTakesTooLongIsAFailedOne) {
  // No heap is at rest so soon, and nobody waits for so many attempts.
  write_bytes(recipe_, "attempts = 1000000000\n" + std::string(recipe) + "[settle]\ntime_limit = 0.05\n");
  const auto result = run_program(command("--set A --tubes 2 --cases 1 --case-limit 0.3"));
  EXPECT_EQ(result.status, 3);
  EXPECT_THAT(result.err, HasSubstr("tanglebin: A2/1: failed: took longer than 0.3 s"));
}

TEST_F(Generate, AShardSaysThatOthersAreToCome) {
  EXPECT_THAT(run_program(command("--shard 1/2")).out,
              HasSubstr("dataset: other shards are to come or in progress; the last to end completes the "
                        "manifest\n"));
  EXPECT_TRUE(nlohmann::json::parse(run_program(command("--shard 1/2 --json")).out)["dataset"].is_null());
  EXPECT_THAT(run_program(command("--shard 2/2")).out, HasSubstr("dataset: complete, 9 cases, digest "));
}

TEST_F(Generate, WrongUsageIsExitStatus64) {
  EXPECT_EQ(run_program("generate").status, 64);
  EXPECT_EQ(run_program(command("--jobs 0")).status, 64);
  EXPECT_EQ(run_program(command("--progress xml")).status, 64);
  EXPECT_EQ(run_program(command("--no-such-option")).status, 64);
  EXPECT_EQ(run_program("").status, 64);
  EXPECT_EQ(run_program("no-such-command").status, 64);
}

TEST_F(Generate, HelpHasAnExample) {
  const auto result = run_program("generate --help");
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.out, HasSubstr("tanglebin generate recipes/set-a.toml --out dataset"));
}

}  // namespace
}  // namespace tanglebin
