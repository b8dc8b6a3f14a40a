#include "tanglebin/report/model_again.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "tanglebin/experiment/run_experiment.hpp"
#include "tanglebin/report/write_pictures.hpp"
#include "tanglebin/report/write_scenes.hpp"
#include "tests/experiment/small_dataset.hpp"

namespace tanglebin {
namespace {

/// A command that labels every point with the number of its calls, on a dataset of two cases.
class CountingCommand : public testing::Test {
protected:
  CountingCommand() {
    test::write_bytes(
        work_ / "count.sh",
        "echo call >> \"$1\"; calls=$(wc -l < \"$1\")\n"
        "n=$(sed -n 's/^element vertex //p' \"$2\" | head -n 1); yes $calls | head -n \"$n\" > \"$3\"\n");
    const std::string text = "sh count.sh '" + calls_.string() + "' {cloud} {out.txt}";
    settings_ = {.methods = {{"mine", command_of(text, work_.path())}}, .ratios = {0.4}};
  }

  void run_experiment() { tanglebin::run_experiment(dataset_, settings_, wanted_, results_.path(), 1); }

  std::ptrdiff_t calls() const { return std::ranges::count(test::bytes_of(calls_), '\n'); }

  // The label of all points.
  std::int32_t label(ModelAgain& model_again, const CaseId& id) const {
    const SeenCase seen{id, ""};
    const auto model = model_again(settings_.methods.front(), seen, read_seen_case(dataset_, seen));
    return model.value().labels[model.value().filtered.front()];
  }

  test::SmallDataset directory_;
  Dataset dataset_ = directory_.read();
  std::vector<CaseId> wanted_ = cases(dataset_);
  test::TemporaryDirectory work_;
  test::TemporaryDirectory results_;
  std::filesystem::path calls_ = work_ / "calls";
  ExperimentSettings settings_;
};

TEST_F(CountingCommand, RunsOnceMoreForEachCaseThatIsShown) {
  run_experiment();
  const std::ptrdiff_t before = calls();
  ASSERT_EQ(before, std::ssize(wanted_));
  ModelAgain model_again(results_.path(), dataset_, settings_);
  for (int times = 0; times < 2; ++times) {
    std::ptrdiff_t call = before;
    for (const CaseId& id : wanted_) EXPECT_EQ(label(model_again, id), ++call);
  }
  EXPECT_EQ(calls(), 2 * before);
}

TEST_F(CountingCommand, DoesNotRunAgainIfItsModelsWereKept) {
  settings_.keep_models = true;
  run_experiment();
  const std::ptrdiff_t before = calls();
  ModelAgain model_again(results_.path(), dataset_, settings_);
  std::ptrdiff_t call = 0;
  for (const CaseId& id : wanted_) EXPECT_EQ(label(model_again, id), ++call) << "what was scored is shown";
  EXPECT_EQ(calls(), before);
}

TEST_F(CountingCommand, DoesNotRunAgainIfTheCallerHasHadEnough) {
  ModelAgain model_again(results_.path(), dataset_, settings_, [] { throw std::runtime_error("enough"); });
  EXPECT_THROW(label(model_again, wanted_.front()), std::runtime_error);
  EXPECT_FALSE(std::filesystem::exists(calls_));
}

TEST(ModelAgain, LeavesOutAModelWithMoreLabelsThanCanBeShown) {
  Recipe recipe = test::small_recipe();
  constexpr int width = 1600;
  recipe.camera = downward_camera(width, 1000, focal_length_from_hfov(width, 1.22), {0, 0, 0.8});
  const test::SmallDataset directory(recipe);
  const Dataset dataset = directory.read();
  const SeenCase seen{cases(dataset).front(), ""};
  const CaseData data = read_seen_case(dataset, seen);
  ASSERT_GT(data.cloud.points.size(), most_labels_to_show);
  const test::TemporaryDirectory work;
  const test::TemporaryDirectory results;
  test::write_bytes(work / "each.sh",
                    "n=$(sed -n 's/^element vertex //p' \"$1\" | head -n 1); seq 1 \"$n\" > \"$2\"\n");
  const ExperimentSettings settings{
      .methods = {{"each", command_of("sh each.sh {cloud} {out.txt}", work.path())}}, .ratios = {1}};
  run_experiment(dataset, settings, {seen.scene}, results.path(), 1);

  ModelAgain model_again(results.path(), dataset, settings);
  EXPECT_FALSE(model_again(settings.methods.front(), seen, data).has_value());
  EXPECT_TRUE(model_again.left_out().contains({"each", seen}));
  write_pictures(results.path(), dataset, settings, model_again);
  write_scenes(results.path(), dataset, settings, 1, model_again);
  EXPECT_EQ(test::bytes_of(results / "pictures.jsonl"), "");
  EXPECT_EQ(test::bytes_of(results / "scenes.jsonl"), "");
}

}  // namespace
}  // namespace tanglebin
