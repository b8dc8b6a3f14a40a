#include "tanglebin/dataset/generate_dataset.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <map>
#include <set>
#include <sstream>
#include <string>

#include "tanglebin/dataset/case_files.hpp"
#include "tanglebin/dataset/dataset.hpp"
#include "tanglebin/dataset/manifest.hpp"
#include "tanglebin/dataset/sha256.hpp"
#include "tanglebin/dataset/verify_dataset.hpp"
#include "tanglebin/files/json_record.hpp"
#include "tanglebin/io/configuration.hpp"
#include "tanglebin/io/ply.hpp"
#include "tanglebin/runs/file_lock.hpp"
#include "tests/dataset/small_recipe.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/temporary_directory.hpp"

namespace tanglebin {
namespace {

using test::bytes_of;
using test::complaint;
using test::files_below;
using test::small_recipe;
using test::TemporaryDirectory;
using test::write_bytes;
using testing::HasSubstr;

FillSummary generate(const Recipe& recipe, const std::filesystem::path& directory, int jobs = 1) {
  return generate_dataset(recipe, cases(recipe), directory, jobs);
}

// Everything but how long it took.
std::map<std::string, std::string> dataset_in(const std::filesystem::path& directory) {
  auto files = files_below(directory);
  files.erase("times.jsonl");
  return files;
}

std::vector<std::string> paths_in(const CaseRecord& record) {
  std::vector<std::string> paths;
  for (const FileRecord& file : record.files) paths.push_back(file.path);
  return paths;
}

Recipe recipe_of(const std::string& text) {
  std::istringstream in(text);
  return read_recipe(in, "r.toml");
}

const std::string small_set =
    "[[set]]\nname = \"A\"\ntubes = [2]\ncases = 2\n[set.tube]\nradius = 0.0125\nmass = 0.5\nlength = 0.5\n"
    "bend_max_deg = 30\n";

TEST(GenerateDataset, SeveralScannersSeeTheSameSceneAndHaveAFolderEach) {
  const TemporaryDirectory one;
  const TemporaryDirectory two;
  const std::string above = "name = \"above\"\nwidth = 240\nheight = 150\n";
  const Recipe recipe =
      recipe_of("[[scanner]]\n" + above +
                "[[scanner]]\nname = \"beside\"\nwidth = 240\nheight = 150\nsigma = 0.001\n"
                "position = [0.3, 0.8, 1.2]\nlook_at = [0, 0, 0.1]\n[output]\ndepths = true\n" +
                small_set);
  generate(recipe, two.path());
  generate(recipe_of("[scanner]\nwidth = 240\nheight = 150\n[output]\ndepths = true\n" + small_set),
           one.path());

  auto files = dataset_in(two.path());
  auto single = dataset_in(one.path());
  EXPECT_EQ(files.at("A2/tube_configurations/1.txt"), single.at("A2/tube_configurations/1.txt"));
  EXPECT_EQ(files.at("A2/above/plys/1.ply"), single.at("A2/plys/1.ply"));
  EXPECT_NE(files.at("A2/beside/plys/1.ply"), files.at("A2/above/plys/1.ply"));
  EXPECT_TRUE(files.contains("A2/beside/depths/2.json"));
  std::istringstream manifest(files.at("manifest.jsonl"));
  std::string line;
  std::getline(manifest, line);
  const CaseRecord record = case_record(line, "manifest.jsonl", 1);
  ASSERT_EQ(record.scanners.size(), 2U);
  EXPECT_EQ(record.scanners[0].points, record.points);
  EXPECT_EQ(record.scanners[1].name, "beside");
  EXPECT_EQ(record.scanners[1].points, read_ply(two / "A2/beside/plys/1.ply").points.size());
  EXPECT_EQ(record.files.size(), 8U);
  EXPECT_EQ(paths_in(record), paths_of(recipe, record.id));
}

TEST(GenerateDataset, NumbersThatAreDrawnStandInTheManifestAndDependOnNoWorker) {
  const TemporaryDirectory one;
  const TemporaryDirectory again;
  const std::string text =
      "[bin]\nheight = { min = 0.15, max = 0.25 }\n[scanner]\nwidth = 240\nheight = 150\n"
      "sigma = { min = 0, max = 0.001 }\nposition = [0, 0, { one_of = [1.5, 2.0] }]\n" +
      small_set;
  generate(recipe_of(text), one.path());
  generate(read_recipe(one / "recipe.toml"), again.path(), 2);
  EXPECT_EQ(dataset_in(one.path()), dataset_in(again.path()));

  const Dataset dataset = read_dataset(one.path());
  std::set<double> heights;
  for (const CaseId& id : cases(dataset)) {
    const CaseRecord record = dataset.catalogue.record(id);
    const Recipe recipe = recipe_of(dataset, id);
    EXPECT_EQ(record.drawn.size(), 3U);
    EXPECT_EQ(record.drawn[0].path, "bin.height");
    EXPECT_EQ(recipe.bin.height, record.drawn[0].value);
    EXPECT_EQ(recipe.sensor.sigma, record.drawn[1].value);
    EXPECT_EQ(recipe.camera.pose.translation().z(), record.drawn[2].value);
    heights.insert(recipe.bin.height);
    EXPECT_FALSE(read_case(dataset, id).cloud.points.empty());
  }
  EXPECT_EQ(heights.size(), 2U);
}

TEST(GenerateDataset, EachTubeMayBeDrawnFromNumbersOfItsOwn) {
  const TemporaryDirectory directory;
  const Recipe recipe = recipe_of(
      "[scanner]\nwidth = 240\nheight = 150\n"
      "[tube]\nradius = { mean = 0.01, sigma = 0.001, per = \"tube\" }\ndensity = 1200\nlength = 0.4\n"
      "bend_max_deg = 30\n"
      "[[set]]\nname = \"A\"\ntubes = [3]\ncases = 2\n"
      "[[set.tube]]\nweight = 2\n[[set.tube]]\nweight = 1\nlength = { min = 0.2, max = 0.3 }\n");
  generate(recipe, directory.path(), 2);
  EXPECT_THAT(verify_dataset(directory.path(), {.jobs = 1, .rest = true}).faults, testing::IsEmpty());

  const Dataset dataset = read_dataset(directory.path());
  std::set<double> radii;
  for (const CaseId& id : cases(dataset)) {
    const SetRecipe set = recipe_of(dataset, id).sets[0];
    for (const Tube& tube : read_case(dataset, id).tubes) {
      EXPECT_EQ(tube.radius, kind_of(set, tube.id).radius);
      radii.insert(tube.radius);
    }
    EXPECT_EQ(set.kinds[0].radius, 0.01) << "what is known of the kind";
  }
  EXPECT_EQ(radii.size(), 6U);
}

TEST(GenerateDataset, WhatHidesAndTouchesWhatIsWrittenOnRequest) {
  const TemporaryDirectory directory;
  const Recipe recipe =
      recipe_of("[scanner]\nwidth = 240\nheight = 150\n[output]\nocclusions = true\n" + small_set);
  generate(recipe, directory.path());
  EXPECT_EQ(recipe_in(directory.path()), recipe);
  const Dataset dataset = read_dataset(directory.path());
  const CaseId id = cases(dataset).front();
  EXPECT_THAT(paths_in(dataset.catalogue.record(id)), testing::Contains("A2/occlusions/1.json"));
  const Json facts = Json::parse(bytes_of(directory / "A2/occlusions/1.json"));
  const CaseData data = read_case(dataset, id);
  ASSERT_EQ(facts["tubes"].size(), 2U);
  for (const Json& tube : facts["tubes"])
    EXPECT_EQ(tube["visible_pixels"], std::ranges::count(data.cloud.labels, tube["id"].get<int>()));
  EXPECT_GE(facts["contacts"].size(), 2U) << "tubes at rest touch something";
}

TEST(GenerateDataset, CloudsMayBeLeftOut) {
  const TemporaryDirectory directory;
  Recipe recipe =
      recipe_of("[scanner]\nwidth = 240\nheight = 150\n[output]\nplys = false\ndepths = true\n" + small_set);
  generate(recipe, directory.path());
  const auto files = files_below(directory.path());
  EXPECT_FALSE(files.contains("A2/plys/1.ply"));
  EXPECT_TRUE(files.contains("A2/depths/1.png"));
  EXPECT_THAT(verify_dataset(directory.path(), {}).faults, testing::IsEmpty());
  EXPECT_EQ(complaint([&] {
              read_case(read_dataset(directory.path()), {"A", 2, 1});
            }),
            (directory / "recipe.toml").string() +
                ": output.plys: found false, so the dataset has no clouds, expected true; generate a dataset "
                "with clouds");
}

TEST(GenerateDataset, WritesThePublishedLayoutAndAManifestOfIt) {
  const TemporaryDirectory directory;
  Recipe recipe = small_recipe();
  recipe.output = {.bin_points = true, .worlds = true, .pcds = true, .depths = true, .labels = true};
  const FillSummary summary = generate(recipe, directory.path());
  EXPECT_TRUE(summary.is_complete());
  EXPECT_EQ(summary.progress.made, 6U);

  auto files = files_below(directory.path());
  std::istringstream manifest(files.at("manifest.jsonl"));
  std::string line;
  std::size_t listed = 0;
  for (const CaseId& id : cases(recipe)) {
    ASSERT_TRUE(std::getline(manifest, line));
    const CaseRecord record = case_record(line, "manifest.jsonl", 1);
    EXPECT_EQ(record.id, id);  // in the recipe's order
    EXPECT_EQ(record.files.size(), 7U);
    EXPECT_EQ(paths_in(record), paths_of(recipe, id));
    for (const FileRecord& file : record.files) {
      EXPECT_EQ(files.at(file.path).size(), file.bytes);
      EXPECT_EQ(sha256(files.at(file.path)), file.sha256);
      ++listed;
    }
    const PointCloud cloud = read_ply(directory / record.files[0].path);
    EXPECT_EQ(cloud.points.size(), record.points);
    EXPECT_EQ(read_configuration(directory / record.files[1].path).size(),
              static_cast<std::size_t>(id.tubes));
  }
  EXPECT_EQ(files.size(), listed + 5);  // the manifest, its digest, the times, the recipe and the lock
  std::istringstream written(files.at("recipe.toml"));
  EXPECT_EQ(cases(read_recipe(written, "recipe.toml")), cases(recipe));
}

TEST(GenerateDataset, WithoutTheBinTheCloudHasTheTubesPointsOnly) {
  const TemporaryDirectory directory;
  Recipe recipe = small_recipe();
  recipe.output.bin_points = false;
  generate(recipe, directory.path());
  const PointCloud cloud = read_ply(directory / "A3/plys/1.ply");
  EXPECT_FALSE(cloud.labels.empty());
  EXPECT_THAT(cloud.labels, testing::Each(testing::Gt(0)));
}

TEST(GenerateDataset, TheSameRecipeGivesTheSameBytesWithAnyNumberOfJobs) {
  const TemporaryDirectory one;
  const TemporaryDirectory two;
  const TemporaryDirectory three;
  generate(small_recipe(), one.path(), 1);
  generate(small_recipe(), two.path(), 1);
  generate(small_recipe(), three.path(), 2);
  const auto expected = dataset_in(one.path());
  EXPECT_EQ(dataset_in(two.path()), expected);
  EXPECT_EQ(dataset_in(three.path()), expected);
}

TEST(GenerateDataset, GoesOnWhereARunWasStopped) {
  const TemporaryDirectory whole;
  const TemporaryDirectory parts;
  const Recipe recipe = small_recipe();
  generate(recipe, whole.path());

  std::vector<CaseId> some = cases(recipe);
  some = {some[4], some[1]};
  EXPECT_EQ(generate_dataset(recipe, some, parts.path(), 2).progress.made, 2U);
  const FillSummary rest = generate(recipe, parts.path());
  EXPECT_EQ(rest.progress.found, 2U);
  EXPECT_EQ(rest.progress.made, 4U);
  EXPECT_EQ(dataset_in(parts.path()), dataset_in(whole.path()));
  EXPECT_EQ(generate(recipe, parts.path()).progress.made, 0U);
}

TEST(GenerateDataset, TakesUpTheJournalOfARunThatWasCutOff) {
  const TemporaryDirectory whole;
  const TemporaryDirectory cut;
  const Recipe recipe = small_recipe();
  generate(recipe, whole.path());
  generate(recipe, cut.path());

  // As after a power cut: two cases are in the journal, the line of a third is torn, nothing is in the
  // manifest.
  std::istringstream manifest(bytes_of(cut / "manifest.jsonl"));
  std::istringstream times(bytes_of(cut / "times.jsonl"));
  std::string journal;
  std::string record;
  std::string time;
  for (int line = 0; line < 3 && std::getline(manifest, record) && std::getline(times, time); ++line) {
    journal += record + '\t' + time + '\n';
  }
  journal.resize(journal.size() - 9);
  write_bytes(cut / "journal.jsonl", journal);
  std::filesystem::remove(cut / "manifest.jsonl");
  std::filesystem::remove(cut / "times.jsonl");

  const FillSummary summary = generate(recipe, cut.path());
  EXPECT_EQ(summary.progress.found, 2U);
  EXPECT_EQ(summary.progress.made, 4U);
  EXPECT_EQ(dataset_in(cut.path()), dataset_in(whole.path()));
}

TEST(GenerateDataset, ACaseThatTheRecipeDoesNotHaveIsRefusedBeforeAnythingIsWritten) {
  const TemporaryDirectory directory;
  const Recipe recipe = small_recipe();
  for (const CaseId& id : {CaseId{"A", 99, 1}, CaseId{"A", 1, -1}, CaseId{"Z", 1, 1}}) {
    EXPECT_EQ(complaint([&] { generate_dataset(recipe, {id}, directory / "new", 1); }),
              "wanted: found '" + name_of(id) + "', expected a case of the recipe");
    EXPECT_FALSE(std::filesystem::exists(directory / "new"));
  }
}

TEST(GenerateDataset, AnotherRecipeIsNotLetIn) {
  const TemporaryDirectory directory;
  Recipe recipe = small_recipe();
  generate_dataset(recipe, {{"A", 1, 1}}, directory.path(), 1);
  recipe.seed = 8;
  EXPECT_EQ(complaint([&] { generate(recipe, directory.path()); }),
            (directory / "recipe.toml").string() +
                ": the directory belongs to another recipe: seed: it has 7, this one 8");
}

TEST(GenerateDataset, OneRunAtATime) {
  const TemporaryDirectory directory;
  {
    const auto other = FileLock::take(directory / "journal.jsonl");
    ASSERT_TRUE(other.has_value());
    EXPECT_EQ(complaint([&] { generate(small_recipe(), directory.path()); }),
              directory.path().string() + ": another run is writing here");
  }
  EXPECT_TRUE(generate(small_recipe(), directory.path()).is_complete());
}

TEST(GenerateDataset, ADirectoryThatCannotBeMadeIsAnError) {
  const TemporaryDirectory directory;
  write_bytes(directory / "file", "");
  EXPECT_THAT(complaint([&] { generate(small_recipe(), directory / "file" / "dataset"); }),
              HasSubstr("file: found a file, expected a directory"));
}

TEST(GenerateDataset, AFullDiskLosesNoFinishedCaseAndTheRunGoesOnLater) {
  const TemporaryDirectory whole;
  const TemporaryDirectory full;
  const Recipe recipe = small_recipe();
  generate(recipe, whole.path());
  generate_dataset(recipe, {{"A", 1, 1}}, full.path(), 1);

  // A limit on the size of files stands for the disk's end: no cloud fits under it any more, but small files
  // do.
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{.rlim_cur = 16000, .rlim_max = before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  const std::string error = complaint([&] { generate(recipe, full.path()); });
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_THAT(error, HasSubstr("A1/plys/2.ply: cannot write: File too large"));
  EXPECT_THAT(files_below(full.path() / "A1/plys"), testing::SizeIs(1));

  const FillSummary summary = generate(recipe, full.path());
  EXPECT_EQ(summary.progress.found, 1U);
  EXPECT_EQ(dataset_in(full.path()), dataset_in(whole.path()));
}

}  // namespace
}  // namespace tanglebin
