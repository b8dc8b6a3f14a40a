// A benchmark as a user runs it: algorithms from outside beside ours, in one experiment.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "tanglebin/io/ply.hpp"
#include "tests/support/program.hpp"
#include "tests/support/recipe_text.hpp"

namespace tanglebin {
namespace {

namespace fs = std::filesystem;
using test::bytes_of;
using test::ProgramResult;
using test::run_program;
using test::run_shell;
using test::write_bytes;
using testing::AllOf;
using testing::HasSubstr;

const fs::path examples = fs::path(TANGLEBIN_SOURCE) / "examples" / "benchmark";

class Benchmark : public testing::Test {
protected:
  Benchmark() {
    const std::string recipe = test::recipe_text({.seed = 3, .width = 960, .tubes = "[1, 3]", .cases = 3});
    EXPECT_EQ(run_program("generate - --out " + path("dataset"), recipe).status, 0);
    // Of the same cloud always the same, whoever is asked.
    write_bytes(
        path("crash.sh"),
        "if [ $(($(cksum <\"$1\" | cut -d ' ' -f 1) % 3)) = 0 ]; then kill -SEGV $$; fi\n" + one_label);
    write_bytes(path("hang.sh"), "if /usr/bin/python3 -c 'import sys; sys.exit(bytes.fromhex(\"" +
                                     point_on_a_tube(path("dataset/A3/plys/1.ply")) +
                                     "\") not in open(sys.argv[1], \"rb\").read())' \"$1\"\n"
                                     "then sleep 1000 & setsid sleep 1000; fi\n" +
                                     one_label);
  }

  std::string path(const std::string& name) const { return (directory_ / name).string(); }

  ProgramResult experiment(const std::string& out, const std::string& options) const {
    return run_program("experiment " + path("dataset") + " --out " + path(out) + " --downsample 0.5,1 " +
                       options);
  }

  // What does not depend on the clock.
  std::string results_in(const std::string& out) const {
    std::string text;
    for (const char* file :
         {"/results.jsonl", "/results.csv", "/tubes.csv", "/experiment.json", "/generation.jsonl"})
      text += bytes_of(path(out + file));
    return text;
  }

  // The number of rows of a method, and how many of them failed for a reason.
  std::pair<int, std::map<std::string, int>> rows_of(const std::string& method,
                                                     const std::string& out) const {
    std::istringstream lines(bytes_of(path(out + "/results.jsonl")));
    std::pair<int, std::map<std::string, int>> rows;
    for (std::string line; std::getline(lines, line);) {
      const auto json = nlohmann::json::parse(line);
      if (json.at("method") != method) continue;
      ++rows.first;
      if (json.contains("failure")) ++rows.second[json.at("failure").get<std::string>()];
    }
    return rows;
  }

  double mean_of(const std::string& method, const std::string& out) const {
    std::istringstream lines(bytes_of(path(out + "/results.jsonl")));
    double sum = 0;
    int count = 0;
    for (std::string line; std::getline(lines, line);) {
      const auto json = nlohmann::json::parse(line);
      if (json.at("method") != method) continue;
      sum += json.value("micro_recall", 0.0);
      ++count;
    }
    return sum / count;
  }

  static inline const std::string one_label =
      "n=$(sed -n 's/^element vertex //p' \"$1\" | head -n 1)\nyes 1 | head -n \"$n\" >\"$2\"\n";

  test::TemporaryDirectory directory_;

private:
  // The position of one, as PLY has it: bytes in hexadecimal.
  static std::string point_on_a_tube(const std::string& file) {
    const PointCloud cloud = read_ply(fs::path(file));
    const auto label = std::ranges::find_if(cloud.labels, [](std::int32_t its) { return its > 0; });
    const Eigen::Vector3f& point = cloud.points[static_cast<std::size_t>(label - cloud.labels.begin())];
    std::string text;
    for (const std::uint8_t byte :
         std::bit_cast<std::array<std::uint8_t, 12>>(std::array<float, 3>{point.x(), point.y(), point.z()}))
      text += fmt::format("{:02x}", byte);
    return text;
  }
};

// Options for the built-in methods and the reference entries, as far as they are at hand.
std::string entries_at_hand() {
  std::string options = "--method axis ";
#ifdef TANGLEBIN_REFERENCE_ENTRIES
  const std::string entries = TANGLEBIN_REFERENCE_ENTRIES;
  options += "--method paper --method clusters='" + entries +
             "/euclidean_clusters {cloud.pcd} {scene} {out.pcd}' --method regions='" + entries +
             "/region_growing {cloud.pcd} {scene} {out.pcd}' ";
#endif
  if (run_shell("/usr/bin/python3 -c 'import sklearn'").status == 0)
    options += "--method dbscan='/usr/bin/python3 " + (examples / "dbscan.py").string() +
               " {cloud} {scene} {out.npy}' ";
  return options;
}

TEST_F(Benchmark, IsTheSameWithOneWorkerTwoWorkersTwoShardsAndAfterKills) {
  const std::string options = entries_at_hand() + "--method crash='sh " + path("crash.sh") +
                              " {cloud} {out.txt}' --method hang='sh " + path("hang.sh") +
                              " {cloud} {out.txt}' --time-limit 20 --json";
  const ProgramResult one = experiment("one", options + " --jobs 1");
  EXPECT_EQ(one.status, 3) << one.err;
  const auto [rows, crashes] = rows_of("crash", "one");
  EXPECT_EQ(rows, 12);
  ASSERT_EQ(crashes.size(), 1U);
  EXPECT_THAT(crashes.begin()->first, HasSubstr("the command was ended by signal 11"));
  const std::map<std::string, int> hangs = rows_of("hang", "one").second;
  ASSERT_EQ(hangs.size(), 1U);
  EXPECT_EQ(hangs.begin()->first, "the command took longer than 20 s");
  EXPECT_LE(hangs.begin()->second, 2) << "of one cloud, at two ratios";
  for (const char* method : {"axis", "paper", "clusters", "regions", "dbscan"})
    EXPECT_TRUE(rows_of(method, "one").second.empty()) << method;
  EXPECT_EQ(nlohmann::json::parse(one.out).at("failed_runs"),
            crashes.begin()->second + hangs.begin()->second);
  EXPECT_THAT(bytes_of(path("one/results.csv")), HasSubstr(",method,the command took longer than 20 s,0.0,"));

  EXPECT_EQ(experiment("two", options + " --jobs 2").status, 3);
  EXPECT_EQ(results_in("two"), results_in("one"));

  for (const char* shard : {"1", "2"})
    experiment(std::string("part") + shard, options + " --shard " + shard + "/2 --jobs 1");
  const ProgramResult merged =
      run_program("merge " + path("part2") + " " + path("part1") + " --out " + path("merged"));
  EXPECT_EQ(merged.status, 0) << merged.err;
  EXPECT_EQ(merged.out, path("merged") + ": 6 cases with results\n");
  EXPECT_EQ(results_in("merged"), results_in("one"));

  for (const char* seconds : {"0.3", "0.7", "1.5", "2.5"}) {
    run_shell(std::string("timeout -s KILL ") + seconds + " " + TANGLEBIN_PROGRAM + " experiment " +
              path("dataset") + " --out " + path("killed") + " --downsample 0.5,1 --jobs 2 " + options);
  }
  EXPECT_EQ(experiment("killed", options + " --jobs 2").status, 3);
  EXPECT_EQ(results_in("killed"), results_in("one"));
  EXPECT_FALSE(fs::exists(path("killed/.journal.unfinished")));

  const ProgramResult page = run_program("report " + path("one") + " --out " + path("page.html"));
  EXPECT_EQ(page.status, 0) << page.err;
  EXPECT_THAT(bytes_of(path("page.html")),
              AllOf(HasSubstr("runs failed; a failed run counts as one that found nothing"),
                    HasSubstr("tanglebin experiment " + path("dataset") + " --out " + path("one")),
                    HasSubstr("tanglebin report " + path("one") + " --out " + path("page.html"))));
}

TEST_F(Benchmark, SettingsOfABuiltInMethodAreComparedByName) {
  write_bytes(path("strict.toml"), "format = 1\naxis.label.distance_max = 0.01\n");
  write_bytes(path("same.toml"), "format = 1\n");
  const std::string options = "--method axis --method same=axis:" + path("same.toml") +
                              " --method strict=axis:" + path("strict.toml");
  const ProgramResult run = experiment("results", options);
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(rows_of("strict", "results").first, 12);
  EXPECT_EQ(mean_of("same", "results"), mean_of("axis", "results"));
  EXPECT_NE(mean_of("strict", "results"), mean_of("axis", "results"));
  EXPECT_EQ(run_program("report " + path("results") + " --out " + path("page.html")).status, 0);
  EXPECT_THAT(bytes_of(path("page.html")), HasSubstr("--method strict=axis:" + path("strict.toml")));

  write_bytes(path("strict.toml"), "format = 1\naxis.label.distance_max = 0.02\n");
  EXPECT_EQ(experiment("results", options).status, 2) << "another experiment";
}

TEST_F(Benchmark, OurOwnLabelsInADirectoryHaveOurScores) {
  ASSERT_EQ(experiment("ours", "--method axis --keep").status, 0);
  const ProgramResult copy = experiment("copy", "--labels copy=" + path("ours/models/axis/{ratio}"));
  ASSERT_EQ(copy.status, 0) << copy.err;
  const ProgramResult compared =
      run_program("compare " + path("ours") + " " + path("copy") + " --json --fail-below 0");
  EXPECT_EQ(compared.status, 0) << compared.err;
  const auto json = nlohmann::json::parse(compared.out);
  EXPECT_EQ(json.at("scenes"), 6);
  for (const auto& measure : json.at("measures")) {
    EXPECT_EQ(measure.at("baseline"), measure.at("other")) << measure;
    EXPECT_EQ(measure.at("interval"), nlohmann::json::parse("[0.0, 0.0]"));
  }
  EXPECT_TRUE(json.at("better").empty() && json.at("worse").empty());

  // Other labels are found out, and their scenes modelled again.
  fs::copy(path("ours/models/axis/1/A1/plys/1.ply"), path("ours/models/axis/1/A1/plys/2.ply"),
           fs::copy_options::overwrite_existing);
  const ProgramResult again =
      experiment("copy", "--labels copy=" + path("ours/models/axis/{ratio}") + " --json");
  EXPECT_EQ(nlohmann::json::parse(again.out).at("made"), 1);
  EXPECT_EQ(again.status, 3);
  EXPECT_EQ(run_program("compare " + path("ours") + " " + path("copy") + " --fail-below -0.002").status, 7);
}

TEST_F(Benchmark, ADirectoryOfLabelsIsScoredAsEachOfItsFiles) {
  ASSERT_EQ(experiment("ours", "--method axis --keep").status, 0);
  const std::string labels = path("ours/models/axis/0.5");
  const ProgramResult all = run_program("score " + path("dataset") + " " + labels + " --json");
  EXPECT_EQ(all.status, 0) << all.err;
  std::istringstream lines(all.out);
  nlohmann::json scene;
  int scenes = 0;
  for (std::string line; std::getline(lines, line) && line.find("means") == std::string::npos; ++scenes)
    scene = nlohmann::json::parse(line);
  EXPECT_EQ(scenes, 6);
  const auto single = nlohmann::json::parse(
      run_program("score --truth " + path("dataset/A3/plys/3.ply") + " --labelled " + labels +
                  "/A3/plys/3.ply" + " --true-tubes " + path("dataset/A3/tube_configurations/3.txt") +
                  " --modelled-tubes " + labels + "/A3/tube_configurations/3.txt --json")
          .out);
  for (const auto& [name, value] : single.items()) {
    if (name == "tubes") continue;  // each of them, which a row does not have
    EXPECT_EQ(scene.at(name), value) << name;
  }

  fs::remove(labels + "/A1/plys/2.ply");
  fs::remove(labels + "/A1/tube_configurations/2.txt");
  const ProgramResult some = run_program("score " + path("dataset") + " " + labels);
  EXPECT_EQ(some.status, 3);
  EXPECT_THAT(some.out, testing::ContainsRegex("A1/2 +found no labels"));
  EXPECT_THAT(some.out, testing::ContainsRegex("\nA +1 +3 +1 +0.6"));
  EXPECT_EQ(run_program("score " + path("dataset") + " " + path("absent")).status, 2);
  EXPECT_EQ(run_program("score " + path("dataset")).status, 64);
  EXPECT_EQ(run_program("score").status, 64);
}

// A job that makes labels while they are scored: some are not there yet, one is cut off.
TEST_F(Benchmark, LabelsThatWereMissingOrBrokenAreScoredOnceTheyAreThere) {
  ASSERT_EQ(experiment("ours", "--method axis --keep").status, 0);
  const fs::path made = path("ours/models/axis/1/A3/plys");
  const fs::path labels = path("labels/A3/plys");
  fs::create_directories(labels);
  fs::copy(made / "1.ply", labels / "1.ply");
  write_bytes((labels / "2.ply").string(), "ply\n");
  const std::string options = "--labels mine=" + path("labels") + " --tubes 3";
  EXPECT_EQ(experiment("scores", options).status, 3);
  EXPECT_THAT(experiment("scores", options).out, HasSubstr("3 already there"));

  fs::copy(made / "2.ply", labels / "2.ply", fs::copy_options::overwrite_existing);
  fs::copy(made / "3.ply", labels / "3.ply");
  const ProgramResult later = experiment("scores", options);
  EXPECT_EQ(later.status, 0) << later.err;
  EXPECT_THAT(later.out, AllOf(HasSubstr("2 cases modelled"), HasSubstr("1 already there")));
  fs::remove(labels / "3.ply");
  EXPECT_EQ(experiment("scores", options).status, 3);
}

TEST_F(Benchmark, TheReferenceEntriesOfThePointCloudLibraryRun) {
#ifdef TANGLEBIN_REFERENCE_ENTRIES
  const fs::path entries = TANGLEBIN_REFERENCE_ENTRIES;
  const ProgramResult run =
      experiment("results", "--method clusters='" + (entries / "euclidean_clusters").string() +
                                " {cloud.pcd} {scene} {out.pcd}' --method regions='" +
                                (entries / "region_growing").string() + " {cloud.pcd} {scene} {out.pcd}'");
  EXPECT_EQ(run.status, 0) << run.err << bytes_of(path("results/results.jsonl"));
  for (const char* method : {"clusters", "regions"}) {
    EXPECT_EQ(rows_of(method, "results").first, 12);
    EXPECT_GT(mean_of(method, "results"), 0.3) << method;
  }
#else
  GTEST_SKIP() << "without the Point Cloud Library";
#endif
}

TEST_F(Benchmark, TheReferenceEntryOfScikitLearnRuns) {
  if (run_shell("PATH=/usr/bin:/bin python3 -c 'import sklearn'").status != 0)
    GTEST_SKIP() << "needs python3-sklearn";
  const ProgramResult run =
      experiment("results", "--method dbscan='/usr/bin/python3 " + (examples / "dbscan.py").string() +
                                " {cloud} {scene} {out.npy}'");
  EXPECT_EQ(run.status, 0) << run.err << bytes_of(path("results/results.jsonl"));
  EXPECT_GT(mean_of("dbscan", "results"), 0.3);
}

TEST_F(Benchmark, TheReferenceEntriesAreShort) {
  int entries = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(examples)) {
    const std::string text = bytes_of(entry.path());
    EXPECT_LT(std::ranges::count(text, '\n'), 100) << entry.path();
    ++entries;
  }
  EXPECT_GE(entries, 4);
}

TEST_F(Benchmark, BadInputIsExitStatusTwoAndNothingIsBegun) {
  const auto expect_error = [&](const std::string& options, const std::string& message) {
    const ProgramResult run = experiment("none", options);
    EXPECT_EQ(run.status, 2) << options;
    EXPECT_THAT(run.err, HasSubstr(message));
    EXPECT_FALSE(fs::exists(path("none")));
  };
  expect_error("--method mine='no-such-program {cloud} {out}'",
               "found 'no-such-program', expected a program");
  expect_error("--method mine='true {cloud}'", "{out} or {tubes}");
  expect_error("--method axis=true", "{cloud}");
  expect_error("--method 'axis=true {cloud} {out}'", "another name than that of a built-in method");
  expect_error("--method mine=axis:absent.toml", "absent.toml: cannot be opened");
  expect_error("--method axis=axis:absent.toml", "absent.toml: cannot be opened");
  expect_error("--labels labels", "--labels: found 'labels', expected NAME=");
  expect_error("--labels mine=absent", "absent: found nothing, expected a directory of labels");
  expect_error("--shard 3/2", "--shard");
}

TEST_F(Benchmark, AChangedScriptIsAnotherExperiment) {
  const std::string options =
      "--method mine='sh " + path("crash.sh") + " {cloud} {out.txt}' --cases 1 --tubes 1";
  experiment("results", options);
  write_bytes(path("crash.sh"), one_label);
  const ProgramResult changed = experiment("results", options);
  EXPECT_EQ(changed.status, 2);
  EXPECT_THAT(changed.err, HasSubstr("other_methods: the directory belongs to another experiment"));
  EXPECT_EQ(experiment("results", options + " --time-limit 5").status, 2);
}

TEST_F(Benchmark, PartsOfOtherExperimentsAreNotMerged) {
  fs::create_directories(path("nothing"));
  const std::string options = " --cases 1 --tubes 1 --labels none=" + path("nothing");
  experiment("one", "--method axis" + options);
  experiment("two", "--method axis --seed 7" + options);
  const ProgramResult merged =
      run_program("merge " + path("one") + " " + path("two") + " --out " + path("m"));
  EXPECT_EQ(merged.status, 2);
  EXPECT_THAT(merged.err, HasSubstr("seed: the directory belongs to another experiment"));
}

}  // namespace
}  // namespace tanglebin
