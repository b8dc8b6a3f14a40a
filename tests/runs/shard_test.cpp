#include "tanglebin/runs/shard.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <string>

#include "tests/dataset/small_recipe.hpp"
#include "tests/support/complaint.hpp"

namespace tanglebin {
namespace {

using test::complaint;
using test::small_recipe;
using testing::HasSubstr;

Environment environment(const std::map<std::string, std::string>& variables) {
  return [variables](const std::string& name) -> std::optional<std::string> {
    const auto found = variables.find(name);
    return found == variables.end() ? std::nullopt : std::optional(found->second);
  };
}

std::string shard_in(const std::map<std::string, std::string>& variables) {
  const std::optional<Shard> shard = shard_from(environment(variables));
  return shard ? name_of(*shard) : "none";
}

TEST(Shard, TogetherTheShardsHaveEachCaseOnceAndAboutAsMany) {
  const std::vector<CaseId> all = cases(small_recipe());
  for (int count = 1; count <= 8; ++count) {
    std::vector<CaseId> together;
    for (int index = 1; index <= count; ++index) {
      const std::vector<CaseId> part = part_of({index, count}, all);
      EXPECT_LE(part.size(), all.size() / static_cast<std::size_t>(count) + 1);
      together.insert(together.end(), part.begin(), part.end());
    }
    EXPECT_THAT(together, testing::UnorderedElementsAreArray(all));
  }
}

TEST(Shard, HasLargeAndSmallScenes) {
  for (const CaseId& id : part_of({1, 3}, cases(small_recipe()))) EXPECT_EQ(id.number, 1);
}

TEST(Shard, OutsideOfAClusterThereIsNone) {
  EXPECT_EQ(shard_in({}), "none");
  EXPECT_EQ(shard_in({{"SLURM_JOB_ID", "7"}}), "none");
}

TEST(Shard, OfASlurmArrayFollowsFromItsNumbersWhereverTheyBegin) {
  const auto array = [](const std::string& id, const std::string& first, const std::string& step) {
    return shard_in({{"SLURM_ARRAY_TASK_ID", id},
                     {"SLURM_ARRAY_TASK_COUNT", "8"},
                     {"SLURM_ARRAY_TASK_MIN", first},
                     {"SLURM_ARRAY_TASK_STEP", step}});
  };
  EXPECT_EQ(array("1", "1", "1"), "1-of-8");
  EXPECT_EQ(array("8", "1", "1"), "8-of-8");
  EXPECT_EQ(array("0", "0", "1"), "1-of-8");
  EXPECT_EQ(array("14", "0", "2"), "8-of-8");
  EXPECT_EQ(
      shard_in(
          {{"SLURM_ARRAY_TASK_ID", "3"}, {"SLURM_ARRAY_TASK_COUNT", "4"}, {"SLURM_ARRAY_TASK_MIN", "1"}}),
      "3-of-4");
}

TEST(Shard, OfAKubernetesJobCountsFromZero) {
  EXPECT_EQ(shard_in({{"JOB_COMPLETION_INDEX", "0"}, {"JOB_COMPLETIONS", "3"}}), "1-of-3");
  EXPECT_EQ(shard_in({{"JOB_COMPLETION_INDEX", "2"}, {"JOB_COMPLETIONS", "3"}}), "3-of-3");
}

TEST(Shard, VariablesThatContradictEachOtherAreAnErrorWithARemedy) {
  const auto expect_error = [](const std::map<std::string, std::string>& variables,
                               const std::string& message) {
    const std::string error = complaint([&] { shard_in(variables); });
    EXPECT_THAT(error, HasSubstr(message));
    EXPECT_THAT(error, HasSubstr("; --shard I/N says which part to make"));
  };
  expect_error({{"SLURM_ARRAY_TASK_ID", "3"}},
               "SLURM_ARRAY_TASK_COUNT: not set, though SLURM_ARRAY_TASK_ID is");
  // --array=1,3,7 has three numbers, but not three of a kind.
  expect_error({{"SLURM_ARRAY_TASK_ID", "7"}, {"SLURM_ARRAY_TASK_COUNT", "3"}, {"SLURM_ARRAY_TASK_MIN", "1"}},
               "SLURM_ARRAY_TASK_ID: found 7, expected one of 3 numbers without a gap");
  expect_error({{"SLURM_ARRAY_TASK_ID", "x"}}, "SLURM_ARRAY_TASK_ID: found 'x'");
  expect_error({{"JOB_COMPLETION_INDEX", "1"}}, "JOB_COMPLETIONS: not set, though JOB_COMPLETION_INDEX is");
  expect_error({{"JOB_COMPLETION_INDEX", "3"}, {"JOB_COMPLETIONS", "3"}}, "JOB_COMPLETION_INDEX: found 3");
  expect_error({{"JOB_COMPLETION_INDEX", "-1"}, {"JOB_COMPLETIONS", "3"}},
               "JOB_COMPLETION_INDEX: found '-1'");
}

TEST(Shard, NumbersMayBeAsLargeAsAnIntHolds) {
  const std::string most = "2147483647";
  EXPECT_EQ(shard_in({{"JOB_COMPLETION_INDEX", "2147483646"}, {"JOB_COMPLETIONS", most}}),
            most + "-of-" + most);
  EXPECT_THAT(complaint([&] {
                shard_in({{"JOB_COMPLETION_INDEX", most}, {"JOB_COMPLETIONS", most}});
              }),
              HasSubstr("JOB_COMPLETION_INDEX: found 2147483647, expected one of 2147483647 numbers"));
  EXPECT_THAT(
      complaint([&] {
        shard_in({{"JOB_COMPLETION_INDEX", "2147483648"}});
      }),
      HasSubstr("JOB_COMPLETION_INDEX: found '2147483648', expected a whole number from 0 to 2147483647;"));
  EXPECT_THAT(complaint([&] {
                shard_in({{"SLURM_ARRAY_TASK_ID", most},
                          {"SLURM_ARRAY_TASK_COUNT", most},
                          {"SLURM_ARRAY_TASK_MIN", most},
                          {"SLURM_ARRAY_TASK_STEP", most},
                          {"SLURM_ARRAY_TASK_MAX", most}});
              }),
              HasSubstr("SLURM_ARRAY_TASK_MAX: found 2147483647, expected 4611686014132420609, the last of"));
}

TEST(Shard, OfAnArrayWithGapsIsAnErrorForEachOfItsTasks) {
  for (const std::string id : {"1", "3", "7"}) {
    EXPECT_EQ(complaint([&] {
                shard_in({{"SLURM_ARRAY_TASK_ID", id},
                          {"SLURM_ARRAY_TASK_COUNT", "3"},
                          {"SLURM_ARRAY_TASK_MIN", "1"},
                          {"SLURM_ARRAY_TASK_MAX", "7"}});
              }),
              "SLURM_ARRAY_TASK_MAX: found 7, expected 3, the last of 3 numbers without a gap; --shard I/N "
              "says which part to make");
  }
}

}  // namespace
}  // namespace tanglebin
