#include "tanglebin/dataset/fill_dataset.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <map>
#include <string>
#include <utility>

#include "tanglebin/base/random.hpp"
#include "tanglebin/runs/file_lock.hpp"
#include "tanglebin/runs/shard.hpp"
#include "tanglebin/runs/workers.hpp"
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
using testing::SizeIs;

// Cases that are files with their name in them, instead of scenes.
MadeCase write_name(const CaseId& id, const CaseWriter& writer) {
  CaseRecord record{id, 1, 0.5, 0, 0, {}, {}};
  const std::string path = file_of(id, "plys", "ply");
  record.files.push_back(writer.write(path, path));
  return {record, {id, {}, 0}};
}

FillRequest request_of(const TemporaryDirectory& directory) {
  const Recipe recipe = small_recipe();
  return {.recipe = recipe, .wanted = cases(recipe), .directory = directory.path(), .jobs = 2};
}

// A shard's part of the cases.
FillRequest request_of(const TemporaryDirectory& directory, const Shard& shard) {
  FillRequest request = request_of(directory);
  request.wanted = part_of(shard, request.wanted);
  request.shard = shard;
  return request;
}

FillSummary fill(const TemporaryDirectory& directory, const Shard& shard) {
  return fill_dataset(request_of(directory, shard), write_name, {});
}

FillSummary fill(const TemporaryDirectory& directory, const MakeCase& make = write_name) {
  return fill_dataset(request_of(directory), make, {});
}

bool is_case(const CaseId& id, int tubes, int number) {
  return id.tubes == tubes && id.number == number;
}

TEST(FillDataset, ACaseThatEndsItsWorkerTwiceIsRecordedAsFailedWithItsSeedAndTheRunGoesOn) {
  const TemporaryDirectory directory;
  const FillSummary summary = fill(directory, [](const CaseId& id, const CaseWriter& writer) {
    if (is_case(id, 1, 2)) std::raise(SIGABRT);  // sanitizers catch SIGSEGV
    return write_name(id, writer);
  });
  EXPECT_EQ(summary.progress.made, 5U);
  EXPECT_FALSE(summary.is_complete());
  EXPECT_FALSE(summary.was_stopped());
  ASSERT_EQ(summary.failed.size(), 1U);
  EXPECT_EQ(summary.failed[0].seed, attempt_seed(small_recipe().seed, "A", 1, 2, 1));
  EXPECT_EQ(bytes_of(directory / "failed.jsonl"), to_json(summary.failed[0]) + '\n');
  EXPECT_THAT(bytes_of(directory / "failed.jsonl"),
              HasSubstr("\"reason\":\"its worker was ended by signal 6, the second time\""));
  EXPECT_EQ(summary.dataset->cases, 5U);
  EXPECT_EQ(summary.dataset->failed, 1U);
}

TEST(FillDataset, AFailedCaseIsTriedAgainByTheNextRunAndForgottenWhenItIsMade) {
  const TemporaryDirectory directory;
  const TemporaryDirectory whole;
  fill(directory, [](const CaseId& id, const CaseWriter& writer) {
    if (is_case(id, 3, 1)) std::raise(SIGKILL);
    return write_name(id, writer);
  });
  const FillSummary again = fill(directory);
  EXPECT_EQ(again.progress.found, 5U);
  EXPECT_TRUE(again.dataset->is_complete());
  fill(whole);
  EXPECT_EQ(files_below(directory.path()), files_below(whole.path()));
}

TEST(FillDataset, AnImpossibleCaseIsAFailedOneAndTheRunGoesOn) {
  const TemporaryDirectory directory;
  FillRequest request = request_of(directory);
  request.jobs = 1;
  const FillSummary summary = fill_dataset(request,
                                           [](const CaseId& id, const CaseWriter& writer) {
                                             if (is_case(id, 1, 1)) throw TaskImpossible("no valid scene");
                                             return write_name(id, writer);
                                           },
                                           {});
  EXPECT_EQ(summary.progress.made, 5U);
  ASSERT_EQ(summary.failed.size(), 1U);
  EXPECT_EQ(summary.failed[0].reason, "no valid scene");
  EXPECT_EQ(bytes_of(directory / "failed.jsonl"), to_json(summary.failed[0]) + '\n');
}

TEST(FillDataset, ShardsFillOneDirectoryAtTheSameTime) {
  const TemporaryDirectory shared;
  const TemporaryDirectory whole;
  const TemporaryDirectory marks;
  fill(whole);
  const auto fill_shard = [&](int index) {
    return fill_dataset(request_of(shared, Shard{index, 2}),
                        [&](const CaseId& id, const CaseWriter& writer) {
                          // Neither shard ends before both have begun.
                          write_bytes(marks / std::to_string(index), "");
                          while (!std::filesystem::exists(marks / std::to_string(3 - index))) usleep(1000);
                          return write_name(id, writer);
                        },
                        {});
  };
  const pid_t child = fork();
  if (child == 0) _exit(fill_shard(2).is_complete() ? 0 : 1);
  EXPECT_TRUE(fill_shard(1).is_complete());
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(files_below(shared.path()), files_below(whole.path()));
}

TEST(FillDataset, WhatAKilledShardHasDoneIsTakenOverByARunOfAllCases) {
  const TemporaryDirectory directory;
  const TemporaryDirectory whole;
  fill(whole);
  const pid_t child = fork();
  if (child == 0) {
    FillRequest request = request_of(directory, Shard{1, 2});
    request.jobs = 1;
    fill_dataset(request, write_name, {.ended = [](const CaseEvent&, const RunProgress& run) {
                   if (run.made == 2) std::raise(SIGKILL);
                 }});
  }
  waitpid(child, nullptr, 0);
  const std::filesystem::path journal = directory / "journal-1-of-2.jsonl";
  EXPECT_TRUE(std::filesystem::exists(journal));
  while (is_locked(journal)) usleep(1000);  // its worker may still wait for the disk

  EXPECT_EQ(fill(directory).progress.found, 2U);
  EXPECT_EQ(files_below(directory.path()), files_below(whole.path()));
  EXPECT_FALSE(std::filesystem::exists(directory / ".journal-1-of-2.unfinished"));
}

TEST(FillDataset, AFinishedDatasetIsNotWrittenAgain) {
  const TemporaryDirectory directory;
  fill(directory);
  const auto written = std::filesystem::last_write_time(directory / "manifest.jsonl");
  const FillSummary again = fill(directory, [](const CaseId&, const CaseWriter&) -> MadeCase { _exit(1); });
  EXPECT_EQ(again.progress.found, 6U);
  EXPECT_TRUE(again.dataset->is_complete());
  EXPECT_EQ(std::filesystem::last_write_time(directory / "manifest.jsonl"), written);
}

TEST(FillDataset, TellsOfEveryCaseAndHowFarTheRunIs) {
  const TemporaryDirectory directory;
  std::vector<std::string> events;
  const RunObserver observer{.ended = [&](const CaseEvent& event, const RunProgress& run) {
    events.push_back(event.failure);
    EXPECT_EQ(run.made + run.failed, events.size());
    EXPECT_EQ(run.wanted, 6U);
  }};
  fill_dataset(
      request_of(directory),
      [](const CaseId& id, const CaseWriter& writer) {
        if (is_case(id, 3, 1)) throw std::runtime_error("broken");
        return write_name(id, writer);
      },
      observer);
  EXPECT_THAT(events, SizeIs(6));
  EXPECT_THAT(events, testing::Contains("broken, the second time").Times(1));
}

TEST(FillDataset, SaysWhatItWasMadeWithAlsoWhereThatChanged) {
  const TemporaryDirectory directory;
  FillRequest request = request_of(directory);
  request.made_with = {{{"ode", "0.16.2"}}};
  request.wanted.pop_back();
  fill_dataset(request, write_name, {});
  request = request_of(directory);
  request.made_with = {{{"ode", "0.17"}}};
  const FillSummary summary = fill_dataset(request, write_name, {});
  EXPECT_EQ(summary.dataset->made_with, (std::set<Versions>{{{"ode", "0.16.2"}}, {{"ode", "0.17"}}}));
  EXPECT_EQ(read_dataset_summary(directory.path())->made_with, summary.dataset->made_with);
}

TEST(FillDataset, ADamagedManifestIsAnErrorThatSaysWhere) {
  const TemporaryDirectory directory;
  fill(directory);
  write_bytes(directory / "manifest.jsonl", "{\"set\":\"A\",\"tubes\":1}\n");
  EXPECT_THAT(complaint([&] { fill(directory); }), HasSubstr("manifest.jsonl:1: "));
}

TEST(FillDataset, AManifestThatCannotBeReadIsNotTakenForNone) {
  const TemporaryDirectory directory;
  fill(directory);
  std::filesystem::rename(directory / "manifest.jsonl", directory / "kept");
  std::filesystem::create_symlink("manifest.jsonl", directory / "manifest.jsonl");
  EXPECT_THAT(complaint([&] { fill(directory); }),
              HasSubstr("manifest.jsonl: cannot be opened: Too many levels of symbolic links"));
  std::filesystem::rename(directory / "kept", directory / "manifest.jsonl");
  EXPECT_EQ(fill(directory).progress.found, 6U);
}

TEST(FillDataset, AJournalOfNothingThatCanBeReadHoldsUpNobody) {
  const TemporaryDirectory whole;
  fill(whole);
  for (const std::string left : {"{\"set\":\"A\",\"tub", "no JSON\n", "{\"set\":\"A\"}\t\n", "\n", "\t\n"}) {
    const TemporaryDirectory directory;
    fill(directory, [](const CaseId& id, const CaseWriter& writer) {
      if (is_case(id, 1, 2)) throw TaskImpossible("not now");
      return write_name(id, writer);
    });
    write_bytes(directory / "journal.jsonl", left);
    EXPECT_EQ(fill(directory).progress.made, 1U) << left;
    EXPECT_EQ(files_below(directory.path()), files_below(whole.path())) << left;
  }
}

TEST(FillDataset, SaysWhatItIsMadeWithEvenIfKilledAndOnlyWhereThereAreCases) {
  const TemporaryDirectory directory;
  const std::set<Versions> first = {{{"ode", "0.16.2"}}};
  const pid_t child = fork();
  if (child == 0) {
    FillRequest request = request_of(directory);
    request.made_with = first;
    fill_dataset(request, write_name,
                 {.ended = [](const CaseEvent&, const RunProgress&) { std::raise(SIGKILL); }});
  }
  waitpid(child, nullptr, 0);
  EXPECT_EQ(Catalogue(directory.path()).made_with(), first);

  EXPECT_EQ(fill(directory).dataset->made_with, first);
  FillRequest later = request_of(directory);
  later.made_with = {{{"ode", "0.17"}}};
  EXPECT_EQ(fill_dataset(later, write_name, {}).dataset->made_with, first);
}

TEST(FillDataset, ShardsOneAfterTheOtherLeaveTheManifestToTheLast) {
  const TemporaryDirectory directory;
  const TemporaryDirectory whole;
  fill(whole);
  for (const int index : {3, 1}) {
    EXPECT_FALSE(fill(directory, {index, 3}).dataset);
    EXPECT_FALSE(std::filesystem::exists(directory / "manifest.jsonl"));
  }
  EXPECT_THAT(Catalogue(directory.path()).cases(), SizeIs(4));  // the journals are as good
  EXPECT_TRUE(fill(directory, {2, 3}).dataset->is_complete());
  EXPECT_EQ(files_below(directory.path()), files_below(whole.path()));
}

TEST(FillDataset, ShardsWithoutACaseCountToo) {
  const TemporaryDirectory directory;
  const TemporaryDirectory whole;
  fill(whole);
  for (int index = 1; index < 10; ++index) EXPECT_FALSE(fill(directory, {index, 10}).dataset);
  EXPECT_TRUE(fill(directory, {10, 10}).dataset->is_complete());
  EXPECT_EQ(files_below(directory.path()), files_below(whole.path()));
}

TEST(FillDataset, AShardThatIsStartedAgainLaterAddsWhatItMakesAndNothingElse) {
  const TemporaryDirectory directory;
  const TemporaryDirectory whole;
  fill(whole);
  const FillSummary first = fill_dataset(request_of(directory, {1, 2}),
                                         [](const CaseId& id, const CaseWriter& writer) {
                                           if (is_case(id, 1, 1)) throw TaskImpossible("not now");
                                           return write_name(id, writer);
                                         },
                                         {});
  EXPECT_EQ(first.failed.size(), 1U);
  EXPECT_EQ(fill(directory, {2, 2}).dataset->failed, 1U);
  const auto written = std::filesystem::last_write_time(directory / "manifest.jsonl");
  EXPECT_FALSE(fill(directory, {2, 2}).dataset->is_complete());  // it has nothing left to make
  EXPECT_EQ(std::filesystem::last_write_time(directory / "manifest.jsonl"), written);

  const FillSummary again = fill(directory, {1, 2});
  EXPECT_EQ(again.progress.made, 1U);
  EXPECT_TRUE(again.dataset->is_complete());
  EXPECT_EQ(files_below(directory.path()), files_below(whole.path()));
}

TEST(FillDataset, ShardsOfAnotherNumberGoOnWithWhatIsThere) {
  const TemporaryDirectory directory;
  const TemporaryDirectory whole;
  fill(whole);
  fill(directory, {1, 3});
  std::size_t found = 0;
  for (const int index : {1, 2}) found += fill(directory, {index, 2}).progress.found;
  EXPECT_EQ(found, 2U);
  EXPECT_EQ(files_below(directory.path()), files_below(whole.path()));
}

TEST(FillDataset, ReadersGoOnWhenTheManifestIsWrittenMeanwhile) {
  const TemporaryDirectory directory;
  fill(directory, {1, 2});
  const Catalogue with_journal(directory.path());
  FillRequest last = request_of(directory);
  last.wanted = {last.wanted.back()};
  fill_dataset(last, write_name, {});
  const Catalogue with_manifest(directory.path());
  EXPECT_THAT(with_manifest.cases(), SizeIs(4));
  fill(directory);  // the other two come between them
  for (const Catalogue* before : {&with_journal, &with_manifest}) {
    for (const CaseId& id : before->cases()) {
      EXPECT_EQ(before->record(id).id, id);
      EXPECT_EQ(before->times(id)->id, id);
    }
    std::size_t times = 0;
    before->for_each_times_line(before->cases(), [&](const std::string&) { ++times; });
    EXPECT_EQ(times, before->cases().size());
  }
}

TEST(FillDataset, ADirectoryOfOtherFilesIsRefusedAndLeftAsItIs) {
  for (const auto& [file, found] : std::map<std::string, std::string>{
           {"experiment.json", "the results of an experiment"}, {"thesis.tex", "thesis.tex"}}) {
    const TemporaryDirectory directory;
    write_bytes(directory / file, "precious");
    write_bytes(directory / "times.jsonl", "precious");
    const auto before = files_below(directory.path());
    EXPECT_EQ(complaint([&] { fill(directory); }),
              directory.path().string() + ": found " + found + ", expected a dataset or an empty directory");
    EXPECT_EQ(files_below(directory.path()), before);
  }
}

TEST(FillDataset, HiddenFilesAreNoOtherFiles) {
  const TemporaryDirectory directory;
  write_bytes(directory / ".gitkeep", "");
  EXPECT_TRUE(fill(directory).is_complete());
}

TEST(FillDataset, ACaseThatTakesTooLongFailsAndIsTriedAgainByTheNextRun) {
  const TemporaryDirectory directory;
  FillRequest request = request_of(directory);
  request.case_limit = std::chrono::seconds(1);
  const FillSummary summary = fill_dataset(request,
                                           [](const CaseId& id, const CaseWriter& writer) {
                                             while (is_case(id, 1, 1)) pause();
                                             return write_name(id, writer);
                                           },
                                           {});
  ASSERT_EQ(summary.failed.size(), 1U);
  EXPECT_EQ(summary.failed[0].reason, "took longer than 1 s");
  EXPECT_TRUE(fill(directory).is_complete());
}

TEST(FillDataset, AShardThatEndsLeavesTheLinesOfOnesAtWorkToThem) {
  const TemporaryDirectory directory;
  FillRequest first = request_of(directory, Shard{1, 2});
  first.jobs = 1;
  bool is_first = true;
  fill_dataset(first, write_name, {.ended = [&](const CaseEvent&, const RunProgress&) {
                 if (!std::exchange(is_first, false)) return;
                 EXPECT_FALSE(fill(directory, {2, 2}).dataset);
                 EXPECT_FALSE(std::filesystem::exists(directory / "dataset.json"));
               }});
  EXPECT_EQ(read_dataset_summary(directory.path())->cases, 6U);
}

}  // namespace
}  // namespace tanglebin
