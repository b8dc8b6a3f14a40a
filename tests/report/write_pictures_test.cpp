#include "tanglebin/report/write_pictures.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "tanglebin/experiment/run_experiment.hpp"
#include "tests/experiment/small_dataset.hpp"

namespace tanglebin {
namespace {

TEST(WritePictures, DrawsTruthAndLabelsOfTheBestTheMedianAndTheWorstRun) {
  const test::SmallDataset directory;
  const test::TemporaryDirectory results;
  const Dataset dataset = directory.read();
  const ExperimentSettings settings{
      .methods = built_in_entries(), .ratios = {0.4, 0.9}, .model = {.seed = 5}};
  run_experiment(dataset, settings, cases(dataset), results.path(), 2);
  ModelAgain model_again(results.path(), dataset, settings);
  write_pictures(results.path(), dataset, settings, model_again);

  std::istringstream lines(test::bytes_of(results / "pictures.jsonl"));
  std::string line;
  double last = 1;
  for (const Method method : methods()) {
    for (const std::string rank : {"best", "median", "worst"}) {
      ASSERT_TRUE(std::getline(lines, line));
      const auto json = nlohmann::json::parse(line);
      EXPECT_EQ(json.at("method"), name_of(method));
      EXPECT_EQ(json.at("rank"), rank);
      EXPECT_EQ(json.at("ratio"), 0.4);
      EXPECT_TRUE(json.contains("set") && json.contains("tubes") && json.contains("case"));
      EXPECT_LE(json.at("micro_recall").get<double>(), rank == "best" ? 1 : last);
      last = json.at("micro_recall").get<double>();
      for (const char* which : {"truth", "labels"}) {
        const auto file = json.at(which).get<std::string>();
        EXPECT_EQ(file, "pictures/" + name_of(method) + "-" + rank + "-" + which + ".png");
        EXPECT_EQ(test::bytes_of(results / file).substr(1, 3), "PNG");
      }
    }
  }
  EXPECT_FALSE(std::getline(lines, line));

  const auto before = test::files_below(results.path());
  write_pictures(results.path(), dataset, settings, model_again);
  EXPECT_EQ(test::files_below(results.path()), before);
}

}  // namespace
}  // namespace tanglebin
