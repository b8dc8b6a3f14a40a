#include "tanglebin/experiment/run_experiment.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tanglebin/base/bytes_of.hpp"
#include "tanglebin/dataset/sha256.hpp"
#include "tanglebin/experiment/results.hpp"
#include "tanglebin/io/configuration.hpp"
#include "tanglebin/io/ply.hpp"
#include "tanglebin/model/parameters.hpp"
#include "tanglebin/runs/file_lock.hpp"
#include "tests/experiment/small_dataset.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/processes.hpp"

namespace tanglebin {
namespace {

using test::bytes_of;
using test::complaint;
using test::files_below;
using test::finely_seen_recipe;
using test::SmallDataset;
using test::TemporaryDirectory;
using test::write_bytes;
using testing::HasSubstr;

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

class RunExperiment : public testing::Test {
protected:
  ExperimentSummary run(const TemporaryDirectory& results, int jobs = 1) const {
    return run(results, cases(dataset_.read()), jobs);
  }
  ExperimentSummary run(const TemporaryDirectory& results, const std::vector<CaseId>& wanted,
                        int jobs = 1) const {
    return run_experiment(dataset_.read(), settings_, wanted, results.path(), jobs);
  }

  // Everything but how long it took.
  static std::map<std::string, std::string> results_in(const TemporaryDirectory& directory) {
    auto files = files_below(directory.path());
    files.erase("times.jsonl");
    return files;
  }

  SmallDataset dataset_;
  ExperimentSettings settings_{.methods = built_in_entries(), .ratios = {0.6, 1}, .model = {.seed = 5}};
};

TEST_F(RunExperiment, LeavesALineForEachRunInTheOrderOfMethodCaseAndRatio) {
  const TemporaryDirectory results;
  const ExperimentSummary summary = run(results, 2);
  EXPECT_TRUE(summary.is_complete());
  EXPECT_EQ(summary.progress.made, 6U);

  const auto lines = lines_of(bytes_of(results / "results.jsonl"));
  const auto times = lines_of(bytes_of(results / "times.jsonl"));
  ASSERT_EQ(lines.size(), settings_.methods.size() * 6 * 2);
  ASSERT_EQ(times.size(), lines.size());
  std::size_t line = 0;
  for (const Entry& method : settings_.methods) {
    for (const CaseId& id : cases(dataset_.read())) {
      for (const double ratio : settings_.ratios) {
        for (const auto& text : {lines[line], times[line]}) {
          const auto json = nlohmann::json::parse(text);
          EXPECT_EQ(json.at("method"), method.name);
          EXPECT_EQ(json.at("set"), id.set);
          EXPECT_EQ(json.at("tubes"), id.tubes);
          EXPECT_EQ(json.at("case"), id.number);
          EXPECT_EQ(json.at("ratio").get<double>(), ratio);
        }
        ++line;
      }
    }
  }
}

TEST_F(RunExperiment, OfADatasetInADirectoryThatIsNotUtf8IsResumed) {
  const TemporaryDirectory place;
  std::filesystem::copy(dataset_ / "", place / "d\xe9s", std::filesystem::copy_options::recursive);
  const Dataset dataset = read_dataset(place / "d\xe9s");
  settings_.methods = {{"theirs", LabelsDirectory{(place / "d\xe9s").string()}}};
  settings_.ratios = {1};
  const TemporaryDirectory results;
  EXPECT_TRUE(run_experiment(dataset, settings_, cases(dataset), results.path(), 1).is_complete());
  EXPECT_EQ(nlohmann::json::parse(bytes_of(results / "experiment.json")).at("dataset"),
            (place / "d\ufffds").string());
  EXPECT_TRUE(run_experiment(dataset, settings_, cases(dataset), results.path(), 1).is_complete());
}

TEST_F(RunExperiment, ModelsTheCloudOfEachScannerAndTellsWhatWasDrawnForTheCase) {
  std::istringstream text(
      "seed = 7\n[[scanner]]\nname = \"left\"\nwidth = 480\nheight = 300\nposition = [-0.1, 0, 2]\n"
      "[[scanner]]\nname = \"right\"\nwidth = 480\nheight = 300\nposition = [0.1, 0, 2]\n"
      "[bin]\nfriction = { min = 0.5, max = 1 }\n"
      "[[set]]\nname = \"A\"\ntubes = [1]\ncases = 2\n"
      "tube = { radius = 0.0125, mass = 0.5, length = 0.3, bend_max_deg = 30 }\n");
  const SmallDataset two_scanners(read_recipe(text, "recipe"));
  const Dataset dataset = two_scanners.read();
  const TemporaryDirectory results;
  const TemporaryDirectory copies;
  settings_.methods = {entry_of(Method::axis)};
  settings_.keep_models = true;
  EXPECT_TRUE(run_experiment(dataset, settings_, cases(dataset), results.path(), 2).is_complete());

  const auto lines = lines_of(bytes_of(results / "results.jsonl"));
  ASSERT_EQ(lines.size(), 2U * 2 * 2) << "cases, scanners, ratios";
  std::size_t line = 0;
  for (const CaseId& id : cases(dataset)) {
    for (const char* scanner : {"left", "right"}) {
      const CaseData data = read_seen_case(dataset, {id, scanner});
      for (const double ratio : settings_.ratios) {
        const auto json = nlohmann::json::parse(lines[line++]);
        EXPECT_EQ(json.at("scanner"), scanner);
        EXPECT_EQ(json.at("ratio").get<double>(), ratio);
        EXPECT_EQ(json.at("drawn").at("bin.friction").get<double>(), recipe_of(dataset, id).bin.friction);
        const RunId run{"axis", id, ratio, scanner};
        const Model model =
            model_case(known_scene(recipe_seen(dataset, {id, scanner}), id), data, run, settings_);
        EXPECT_EQ(json.at("micro_recall").get<double>(), score_model(data, model).labels.micro_recall);
      }
    }
  }
  EXPECT_EQ(run_experiment(dataset, settings_, cases(dataset), results.path(), 1).progress.made, 0U);

  // Labels that exist are looked for by scanner.
  settings_.methods = {{"copy", LabelsDirectory{(results / "models/axis/{ratio}").string()}}};
  settings_.keep_models = false;
  run_experiment(dataset, settings_, cases(dataset), copies.path(), 1);
  const auto copied = lines_of(bytes_of(copies / "results.jsonl"));
  ASSERT_EQ(copied.size(), lines.size());
  for (std::size_t i = 0; i < lines.size(); ++i) {
    EXPECT_EQ(nlohmann::json::parse(copied[i]).at("micro_recall"),
              nlohmann::json::parse(lines[i]).at("micro_recall"));
  }
}

TEST_F(RunExperiment, ABuiltInMethodMayHaveSettingsOfItsOwn) {
  const TemporaryDirectory results;
  ModelSettings other = settings_.model;
  set_parameter(other, "axis.label.distance_max", 0.01);
  settings_.methods = {entry_of(Method::axis),
                       {"same", BuiltIn{Method::axis, "same.toml", settings_.model}},
                       {"other", BuiltIn{Method::axis, "other.toml", other}}};
  settings_.ratios = {1};
  run(results, {{"A", 3, 2}});
  const auto lines = lines_of(bytes_of(results / "results.jsonl"));
  ASSERT_EQ(lines.size(), 3U);
  auto axis = nlohmann::json::parse(lines[0]);
  axis["method"] = "same";
  EXPECT_EQ(nlohmann::json::parse(lines[1]), axis);
  axis["method"] = "other";
  EXPECT_NE(nlohmann::json::parse(lines[2]), axis);
  const auto others = nlohmann::json::parse(bytes_of(results / "experiment.json")).at("other_methods");
  EXPECT_EQ(others.at("other").at("method"), "axis");
  EXPECT_EQ(others.at("other").at("parameters"), nlohmann::json({{"axis.label.distance_max", 0.01}}));
}

TEST_F(RunExperiment, SaysWhatACommandMayUse) {
  const TemporaryDirectory results;
  const ProcessLimits limits{.time = std::chrono::seconds(90), .memory = 1 << 20, .disk = 1 << 10};
  settings_.methods = {{"mine", command_of("true {cloud} {out}", results.path(), limits)}};
  settings_.ratios = {1};
  run(results, {{"A", 3, 2}});
  const auto experiment = nlohmann::json::parse(bytes_of(results / "experiment.json"));
  const auto mine = experiment.at("other_methods").at("mine");
  EXPECT_EQ(mine.at("time_limit"), 90);
  EXPECT_EQ(mine.at("memory_limit"), 1 << 20);
  EXPECT_EQ(mine.at("disk_limit"), 1 << 10);
}

TEST_F(RunExperiment, NeedsClouds) {
  const TemporaryDirectory results;
  Dataset dataset = dataset_.read();
  dataset.recipe.output.plys = false;
  EXPECT_THAT(
      test::complaint([&] { run_experiment(dataset, settings_, cases(dataset), results / "none", 1); }),
      HasSubstr("recipe.toml: output.plys: found false, so the dataset has no clouds"));
  EXPECT_FALSE(std::filesystem::exists(results / "none"));
}

TEST_F(RunExperiment, ALineHasWhatModellingAndScoringTheCaseGive) {
  const TemporaryDirectory results;
  run(results, {{"A", 3, 2}});
  const Dataset dataset = dataset_.read();
  const RunId id{"paper", {"A", 3, 2}, 0.6};
  const CaseData data = read_case(dataset, id.scene);
  const Model model = model_case(known_scene(recipe_of(dataset, id.scene), id.scene), data, id, settings_);
  EXPECT_EQ(lines_of(bytes_of(results / "results.jsonl")).at(0),
            result_json(id, dataset.catalogue.record(id.scene), {.model = model}, score_model(data, model)));
}

TEST_F(RunExperiment, SaysWhatTheResultsFollowFromAndHowLongTheDatasetTook) {
  const TemporaryDirectory results;
  run(results, {{"A", 1, 1}});
  const auto json = nlohmann::json::parse(bytes_of(results / "experiment.json"));
  EXPECT_EQ(json.at("dataset_seed"), 7);
  EXPECT_EQ(json.at("methods").size(), methods().size());
  EXPECT_EQ(json.at("ratios"), (std::vector<double>{0.6, 1}));
  EXPECT_EQ(json.at("seed"), 5);
  EXPECT_EQ(json.at("cases"), 1);
  EXPECT_EQ(json.at("recipe_sha256"), sha256(bytes_of(dataset_ / "recipe.toml")));
  EXPECT_EQ(bytes_of(results / "generation.jsonl"), bytes_of(dataset_ / "times.jsonl"));
  EXPECT_FALSE(std::filesystem::exists(results / "journal.jsonl"));
}

TEST_F(RunExperiment, OneJobOrTwoGiveTheSameBytes) {
  const TemporaryDirectory one;
  const TemporaryDirectory two;
  run(one, 1);
  run(two, 2);
  EXPECT_EQ(results_in(one), results_in(two));
}

TEST_F(RunExperiment, ACasesResultsDoNotDependOnTheOtherCasesAndMoreMayBeAdded) {
  const TemporaryDirectory whole;
  const TemporaryDirectory parts;
  run(whole);
  EXPECT_EQ(run(parts, {{"A", 3, 2}, {"A", 1, 3}}).progress.made, 2U);
  const ExperimentSummary rest = run(parts);
  EXPECT_EQ(rest.progress.found, 2U);
  EXPECT_EQ(rest.progress.made, 4U);
  EXPECT_EQ(results_in(parts), results_in(whole));
  EXPECT_EQ(run(parts).progress.made, 0U);
}

TEST_F(RunExperiment, TakesUpTheJournalOfARunThatWasCutOff) {
  const TemporaryDirectory whole;
  const TemporaryDirectory cut;
  run(whole);
  run(cut, {{"A", 1, 1}});

  // As after a power cut: one case is in the results, one in the journal, and the line of a third is torn.
  const auto results = lines_of(bytes_of(whole / "results.jsonl"));
  const auto times = lines_of(bytes_of(whole / "times.jsonl"));
  std::map<int, std::string> journal;
  for (std::size_t i = 0; i < results.size(); ++i) {
    const auto run = nlohmann::json::parse(results[i]);
    if (run.at("tubes") != 3) continue;
    std::string& line = journal[run.at("case").get<int>()];
    if (!line.empty()) line += '\t';
    line += results[i] + '\t' + times[i];
  }
  const std::string torn = journal.at(2).substr(0, journal.at(2).size() - 20);
  write_bytes(cut / "journal.jsonl", journal.at(1) + '\n' + torn);

  const ExperimentSummary summary = run(cut);
  EXPECT_EQ(summary.progress.found, 2U);
  EXPECT_EQ(summary.progress.made, 4U);
  EXPECT_EQ(results_in(cut), results_in(whole));
}

TEST_F(RunExperiment, AnInterruptedRunGoesOnLater) {
  const TemporaryDirectory whole;
  const TemporaryDirectory parts;
  run(whole);
  const ExperimentSummary first =
      run_experiment(dataset_.read(), settings_, cases(dataset_.read()), parts.path(), 1,
                     {.ended = [](const auto&, const auto&) { raise(SIGINT); }});
  EXPECT_EQ(first.progress.found, 0U);
  EXPECT_EQ(lines_of(bytes_of(parts / "results.jsonl")).size(),
            first.progress.made * settings_.methods.size() * 2);
  EXPECT_FALSE(std::filesystem::exists(parts / "journal.jsonl"));
  EXPECT_EQ(run(parts).progress.found, first.progress.made);
  EXPECT_EQ(results_in(parts), results_in(whole));
}

TEST_F(RunExperiment, KeepsTheModelsWhereAskedAndMakesThoseThatAreMissing) {
  const TemporaryDirectory without;
  const TemporaryDirectory with;
  const std::vector<CaseId> wanted = {{"A", 3, 1}, {"A", 3, 2}};
  run(without, wanted);
  EXPECT_FALSE(std::filesystem::exists(without / "models"));

  settings_.methods = {entry_of(Method::axis)};
  settings_.keep_models = true;
  EXPECT_EQ(run(with, wanted).progress.made, 2U);
  const auto files = results_in(with);
  const Dataset dataset = dataset_.read();
  const RunId id{"axis", {"A", 3, 2}, 0.6};
  const CaseData data = read_case(dataset, id.scene);
  const Model model = model_case(known_scene(recipe_of(dataset, id.scene), id.scene), data, id, settings_);
  EXPECT_EQ(read_ply(with / "models/axis/0.6/A3/plys/2.ply").labels, model.labels);
  EXPECT_EQ(read_configuration(with / "models/axis/0.6/A3/tube_configurations/2.txt").size(),
            model.tubes.size());
  EXPECT_EQ(nlohmann::json::parse(files.at("models/axis/1/A3/tubes/1.json")).at("format"), 1);

  EXPECT_EQ(run(with, wanted).progress.found, 2U);
  std::filesystem::remove(with / "models/axis/0.6/A3/plys/2.ply");
  EXPECT_EQ(run(with, wanted).progress.made, 1U);
  EXPECT_EQ(results_in(with), files);
}

TEST_F(RunExperiment, KeepsModelsOfLabelsThatHaveNoColourOfTheirOwnWithTheSameScores) {
  const TemporaryDirectory axis;
  const TemporaryDirectory without;
  const TemporaryDirectory with;
  const std::vector<CaseId> wanted = {{"A", 3, 1}};
  settings_.methods = {entry_of(Method::axis)};
  settings_.ratios = {1};
  settings_.keep_models = true;
  run(axis, wanted);
  const auto labelled_file = axis / "models/axis/1/A3/plys/1.ply";
  PointCloud labelled = read_ply(labelled_file);
  constexpr std::int32_t surplus = 2'000'000;
  for (std::int32_t& label : labelled.labels) label += label > bin_label ? surplus : 0;
  write_bytes(labelled_file, tanglebin::bytes_of([&](std::ostream& out) { write_ply(out, labelled); }));

  settings_.methods = {{"mine", LabelsDirectory{(axis / "models/axis/1").string()}}};
  run(with, wanted);
  settings_.keep_models = false;
  run(without, wanted);
  const std::string results = bytes_of(with / "results.jsonl");
  EXPECT_GT(nlohmann::json::parse(results).at("micro_recall").get<double>(), 0.5);
  EXPECT_EQ(results, bytes_of(without / "results.jsonl"));
  EXPECT_EQ(read_ply(with / "models/mine/1/A3/plys/1.ply").labels, labelled.labels);
}

TEST_F(RunExperiment, AModelThatCannotBeKeptIsNoFailureOfTheMethod) {
  const TemporaryDirectory results;
  write_bytes(results / "models", "in the way");
  settings_.keep_models = true;
  EXPECT_THAT(complaint([&] { run(results); }), HasSubstr("models: found a file, expected a directory"));
  EXPECT_EQ(bytes_of(results / "results.jsonl"), "");
}

/// What each line of results.jsonl says has failed, and how often.
std::map<std::string, int> failures_in(const TemporaryDirectory& results) {
  std::map<std::string, int> failures;
  for (const std::string& line : lines_of(bytes_of(results / "results.jsonl"))) {
    const auto json = nlohmann::json::parse(line);
    if (!json.contains("failure")) continue;
    EXPECT_FALSE(json.contains("micro_recall"));
    ++failures[json.at("failure_of").get<std::string>() + ": " + json.at("failure").get<std::string>()];
  }
  return failures;
}

TEST_F(RunExperiment, ACaseWithoutAVisibleTubeIsALineForEachRunAndNotTriedAgain) {
  const SmallDataset aside(finely_seen_recipe(30));
  const TemporaryDirectory results;
  const auto run_aside = [&] {
    return run_experiment(aside.read(), settings_, cases(aside.read()), results.path(), 1);
  };
  EXPECT_TRUE(run_aside().is_complete());
  const auto runs = static_cast<int>(6 * settings_.methods.size() * 2);
  EXPECT_EQ(failures_in(results),
            (std::map<std::string, int>{{"scene: no point of the cloud is on a tube", runs}}));
  const auto before = files_below(results.path());
  EXPECT_EQ(run_aside().progress.found, 6U);
  EXPECT_EQ(files_below(results.path()), before);
}

TEST_F(RunExperiment, ACaseThatAMethodCannotModelIsALineAndTheOtherMethodsGoOn) {
  Recipe recipe = finely_seen_recipe();
  recipe.sets[0].kinds.push_back(recipe.sets[0].kinds[0]);
  recipe.sets[0].kinds[1].radius = 0.009;
  const SmallDataset two_radii(recipe);
  const TemporaryDirectory results;
  const ExperimentSummary summary =
      run_experiment(two_radii.read(), settings_, {{"A", 3, 1}}, results.path(), 1);
  EXPECT_TRUE(summary.is_complete());
  EXPECT_EQ(failures_in(results),
            (std::map<std::string, int>{
                {"method: method: the paper's method handles a single radius; use --method axis", 2}}));
  EXPECT_EQ(lines_of(bytes_of(results / "results.jsonl")).size(), settings_.methods.size() * 2);
}

/// A process that kills every other child of this one, until it goes.
class KillerOfWorkers {
public:
  KillerOfWorkers() : process_(fork()) {
    while (process_ == 0) {
      for (const pid_t child : test::children_of(getppid())) {
        if (child != getpid()) kill(child, SIGKILL);
      }
    }
  }
  ~KillerOfWorkers() {
    kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
  }
  KillerOfWorkers(const KillerOfWorkers&) = delete;
  KillerOfWorkers& operator=(const KillerOfWorkers&) = delete;

private:
  pid_t process_;
};

TEST_F(RunExperiment, ACaseThatCrashesIsALineForEachRunUntilALaterRunCanModelIt) {
  const TemporaryDirectory whole;
  const TemporaryDirectory results;
  run(whole, {{"A", 1, 1}});
  {
    const KillerOfWorkers killer;
    const ExperimentSummary summary = run(results, {{"A", 1, 1}});
    EXPECT_FALSE(summary.is_complete());
    EXPECT_EQ(summary.progress.failed, 1U);
  }
  const auto runs = static_cast<int>(settings_.methods.size() * 2);
  EXPECT_EQ(
      failures_in(results),
      (std::map<std::string, int>{{"worker: its worker was ended by signal 9, the second time", runs}}));
  EXPECT_EQ(run(results, {{"A", 1, 1}}).progress.made, 1U);
  EXPECT_EQ(results_in(results), results_in(whole));
}

TEST_F(RunExperiment, ACaseThatIsAnotherSceneNowIsModelledAgain) {
  const TemporaryDirectory results;
  run(results);
  const std::string before = bytes_of(dataset_ / "A3/plys/1.ply");
  std::string after = before;
  after[after.size() - 5] ^= 1;  // the blue of the last point, before its label
  write_bytes(dataset_ / "A3/plys/1.ply", after);
  std::string manifest = bytes_of(dataset_ / "manifest.jsonl");
  manifest.replace(manifest.find(sha256(before)), sha256(before).size(), sha256(after));
  write_bytes(dataset_ / "manifest.jsonl", manifest);

  EXPECT_EQ(run(results).progress.made, 1U);
  const TemporaryDirectory anew;
  run(anew);
  EXPECT_EQ(results_in(results), results_in(anew));
}

TEST_F(RunExperiment, ResultsOfACaseThatTheDatasetLacksAreNotMixedWithItsOwn) {
  const TemporaryDirectory results;
  run(results, {{"A", 1, 1}, {"A", 1, 2}});
  const std::string manifest = bytes_of(dataset_ / "manifest.jsonl");
  write_bytes(dataset_ / "manifest.jsonl", manifest.substr(manifest.find('\n') + 1));
  EXPECT_THAT(complaint([&] { run(results); }),
              HasSubstr("A1/1: the dataset lacks this case, which the results have"));
}

TEST_F(RunExperiment, AnotherBuildOfTheProgramIsNotLetIn) {
  const TemporaryDirectory results;
  run(results, {{"A", 1, 1}});
  auto experiment = nlohmann::ordered_json::parse(bytes_of(results / "experiment.json"));
  EXPECT_EQ(experiment.at("program_sha256"), sha256(bytes_of("/proc/self/exe")));
  experiment["program_sha256"] = "of another";
  write_bytes(results / "experiment.json", experiment.dump() + '\n');
  EXPECT_THAT(complaint([&] { run(results); }),
              HasSubstr("program_sha256: the directory belongs to another build of the program: it has "
                        "\"of another\", this one "));
}

TEST_F(RunExperiment, AnotherExperimentIsNotLetIn) {
  const TemporaryDirectory results;
  run(results, {{"A", 1, 1}});
  const auto before = files_below(results.path());
  const auto expect_refused = [&](const std::string& difference) {
    EXPECT_THAT(complaint([&] { run(results); }), HasSubstr("experiment.json: " + difference));
    EXPECT_EQ(files_below(results.path()), before);
  };
  settings_.model.seed = 6;
  expect_refused("seed: the directory belongs to another experiment: it has 5, this one 6");
  settings_.model.seed = 5;
  settings_.ratios = {0.6};
  expect_refused("ratios: the directory belongs to another experiment: it has [0.6,1.0], this one [0.6]");
  settings_.ratios = {0.6, 1};
  settings_.methods.clear();
  expect_refused("methods: the directory belongs to another experiment: ");
  settings_.methods = built_in_entries();
  write_bytes(dataset_ / "recipe.toml", bytes_of(dataset_ / "recipe.toml") + "# the same cases\n");
  expect_refused("recipe_sha256: the directory belongs to another experiment: ");
}

TEST_F(RunExperiment, ADatasetIsNotWrittenInto) {
  const auto before = files_below(dataset_ / "");
  const Dataset dataset = dataset_.read();
  EXPECT_THAT(complaint([&] { run_experiment(dataset, settings_, cases(dataset), dataset.directory, 1); }),
              HasSubstr("found a dataset, expected a directory for results"));
  EXPECT_EQ(files_below(dataset_ / ""), before);
}

TEST_F(RunExperiment, OneRunAtATime) {
  const TemporaryDirectory results;
  const auto other = FileLock::take(results / "journal.jsonl");
  ASSERT_TRUE(other.has_value());
  EXPECT_THAT(complaint([&] { run(results); }), HasSubstr("another run is writing here"));
}

TEST_F(RunExperiment, AMissingCloudIsAnErrorThatNamesItAndLosesNoFinishedCase) {
  const TemporaryDirectory whole;
  const TemporaryDirectory results;
  run(whole);
  const std::string cloud = bytes_of(dataset_ / "A1/plys/3.ply");
  std::filesystem::remove(dataset_ / "A1/plys/3.ply");
  EXPECT_THAT(complaint([&] { run(results); }), HasSubstr("A1/plys/3.ply: cannot be opened"));
  write_bytes(dataset_ / "A1/plys/3.ply", cloud);
  EXPECT_EQ(run(results).progress.found, 2U);
  EXPECT_EQ(results_in(results), results_in(whole));
}

TEST_F(RunExperiment, ACloudThatHasChangedIsAnErrorThatNamesIt) {
  const TemporaryDirectory results;
  std::string bytes = bytes_of(dataset_ / "A3/plys/1.ply");
  bytes.back() ^= 1;
  write_bytes(dataset_ / "A3/plys/1.ply", bytes);
  EXPECT_THAT(complaint([&] { run(results); }), HasSubstr("A3/plys/1.ply: sha256: found "));
}

}  // namespace
}  // namespace tanglebin
