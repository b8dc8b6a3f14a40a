#include "tanglebin/dataset/verify_dataset.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tanglebin/dataset/generate_dataset.hpp"
#include "tanglebin/dataset/repair_dataset.hpp"
#include "tanglebin/dataset/sha256.hpp"
#include "tanglebin/io/configuration.hpp"
#include "tanglebin/runs/journal.hpp"
#include "tanglebin/runs/shard.hpp"
#include "tests/dataset/small_recipe.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/temporary_directory.hpp"

namespace tanglebin {
namespace {

namespace fs = std::filesystem;
using test::bytes_of;
using test::failed_case_of;
using test::files_below;
using test::small_recipe;
using test::TemporaryDirectory;
using test::write_bytes;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class VerifyDataset : public testing::Test {
protected:
  VerifyDataset() {
    recipe_.output = {
        .bin_points = true, .worlds = true, .pcds = true, .depths = true, .labels = true, .occlusions = true};
    generate_dataset(recipe_, cases(recipe_), path(), 2);
    before_ = dataset();
  }

  fs::path path(const std::string& file = {}) const { return directory_ / file; }

  std::map<std::string, std::string> dataset() const {
    auto files = files_below(directory_.path());
    files.erase("times.jsonl");
    return files;
  }

  VerifySummary verify(bool rest = false) const {
    return verify_dataset(directory_.path(), {.jobs = 2, .rest = rest});
  }

  std::vector<std::string> faults(bool rest = false) const {
    std::vector<std::string> lines;
    for (const auto& [where, what] : verify(rest).faults) lines.push_back(where + ": " + what);
    return lines;
  }

  void replace_in(const std::string& file, const std::string& from, const std::string& to) const {
    std::string bytes = bytes_of(path(file));
    bytes.replace(bytes.find(from), from.size(), to);
    write_bytes(path(file), bytes);
  }

  // Other bytes, which the manifest says are right.
  void forge(const std::string& file, const std::string& bytes) const {
    const std::string old = bytes_of(path(file));
    replace_in(
        "manifest.jsonl",
        "\"path\":\"" + file + "\",\"bytes\":" + std::to_string(old.size()) + ",\"sha256\":\"" + sha256(old),
        "\"path\":\"" + file + "\",\"bytes\":" + std::to_string(bytes.size()) + ",\"sha256\":\"" +
            sha256(bytes));
    write_bytes(path(file), bytes);
  }

  void expect_repair() const {
    EXPECT_THAT(verify().faults, testing::Not(IsEmpty()));
    repair_dataset(directory_.path(), verify(), 2);
    EXPECT_EQ(dataset(), before_);
    EXPECT_THAT(faults(), IsEmpty());
  }

  TemporaryDirectory directory_;
  Recipe recipe_ = small_recipe();
  std::map<std::string, std::string> before_;
};

TEST_F(VerifyDataset, NothingIsWrongWithWhatGenerateMakes) {
  const VerifySummary summary = verify(true);
  EXPECT_THAT(faults(true), IsEmpty());
  EXPECT_EQ(summary.cases, 6U);
  EXPECT_THAT(summary.broken, IsEmpty());
  EXPECT_EQ(dataset(), before_);  // and it is as it was
}

TEST_F(VerifyDataset, FindsAndRepairsFilesThatAreMissingOrHaveChanged) {
  fs::remove(path("A1/depths/2.json"));
  std::string cloud = bytes_of(path("A3/plys/1.ply"));
  cloud[cloud.size() / 2] = static_cast<char>(cloud[cloud.size() / 2] ^ 1);
  write_bytes(path("A3/plys/1.ply"), cloud);
  EXPECT_THAT(faults(), ElementsAre("A1/depths/2.json: cannot be opened: No such file or directory",
                                    HasSubstr("A3/plys/1.ply: sha256: found " + sha256(cloud))));
  EXPECT_THAT(verify().broken, ElementsAre(CaseId{"A", 1, 2}, CaseId{"A", 3, 1}));
  expect_repair();
}

TEST_F(VerifyDataset, RepairsExactlyTheBrokenCases) {
  fs::remove(path("A1/plys/2.ply"));
  const auto untouched = fs::last_write_time(path("A1/plys/3.ply"));
  EXPECT_EQ(repair_dataset(directory_.path(), verify(), 1).progress.made, 1U);
  EXPECT_EQ(fs::last_write_time(path("A1/plys/3.ply")), untouched);
}

TEST_F(VerifyDataset, FindsAndRepairsLinesOfTheManifestThatAreDamagedMissingOrThereTwice) {
  std::string manifest = bytes_of(path("manifest.jsonl"));
  const std::size_t second = manifest.find('\n') + 1;
  manifest[second] = 'x';                                                        // A1/2
  manifest = manifest.substr(0, manifest.rfind('\n', manifest.size() - 2) + 1);  // without A3/3
  manifest += manifest.substr(0, second);                                        // A1/1 again
  write_bytes(path("manifest.jsonl"), manifest);
  const std::vector<std::string> found = faults();
  EXPECT_THAT(found, Contains("A1/1: is in the manifest twice (manifest.jsonl:6)"));
  EXPECT_THAT(found, Contains("missing: 2 of 6 cases: A1/2, A3/3"));
  EXPECT_THAT(found, Contains("A3/plys/3.ply: not in the manifest"));
  EXPECT_THAT(found, Contains(HasSubstr("manifest.jsonl:2: ")));
  EXPECT_THAT(found, Contains(HasSubstr("dataset.json: digest: found ")));
  expect_repair();
}

TEST_F(VerifyDataset, FindsTwoCasesWithTheSameTubes) {
  forge("A1/tube_configurations/2.txt", bytes_of(path("A1/tube_configurations/1.txt")));
  EXPECT_THAT(faults(), Contains("A1/2: has the same tubes as A1/1"));
  expect_repair();
}

TEST_F(VerifyDataset, FindsFormatsThatAreBrokenThoughTheirChecksumsAreRight) {
  forge("A1/plys/1.ply", "ply\nformat ascii 1.0\n");
  forge("A1/tube_configurations/2.txt", "2\n");
  forge("A1/gazebo_worlds/1.world", "<sdf><world>");
  forge("A1/pcds/1.pcd", "VERSION 0.7\n");
  forge("A1/depths/1.png", "no picture");
  forge("A1/depths/1.json", "{");
  forge("A1/labels/3.png", bytes_of(path("A1/labels/3.png")).substr(0, 100));
  forge("A1/occlusions/2.json", "[");
  std::vector<std::string> where;
  for (const DatasetFault& fault : verify().faults) where.push_back(fault.where);
  EXPECT_THAT(where, ElementsAre("A1/depths/1.json", "A1/depths/1.png", "A1/gazebo_worlds/1.world",
                                 "A1/labels/3.png", "A1/occlusions/2.json", "A1/pcds/1.pcd", "A1/plys/1.ply",
                                 "A1/tube_configurations/2.txt", "dataset.json"));
  expect_repair();
}

TEST_F(VerifyDataset, FindsCountsThatAreNotWhatTheManifestAndTheRecipeSay) {
  forge("A3/plys/1.ply", bytes_of(path("A3/plys/2.ply")));
  forge("A1/tube_configurations/1.txt", bytes_of(path("A3/tube_configurations/1.txt")));
  replace_in("manifest.jsonl", R"({"path":"A3/labels/3.png")", R"({"path":"A3/other/3.png")");
  const std::vector<std::string> found = faults();
  EXPECT_THAT(found, Contains(testing::ContainsRegex("A3/plys/1.ply: found [0-9]+ points, expected [0-9]+")));
  EXPECT_THAT(found, Contains("A1/tube_configurations/1.txt: found 3 tubes, expected 1"));
  EXPECT_THAT(found, Contains("A3/3: has no file A3/labels/3.png"));
  EXPECT_THAT(found, Contains("A3/3: has A3/other/3.png, which is none of its own files"));
  EXPECT_THAT(found, Contains("A3/labels/3.png: not in the manifest"));
}

class VerifyPhysics : public VerifyDataset {
protected:
  // Puts the case's first tube elsewhere, which everything but the physics says is right.
  void move_tube(const Eigen::Vector3d& way) const {
    const std::string file = "A3/tube_configurations/2.txt";
    std::vector<Tube> tubes = read_configuration(path(file));
    transform(tubes[0], Eigen::Isometry3d(Eigen::Translation3d(way)));
    std::ostringstream out;
    write_configuration(out, tubes);
    forge(file, out.str());
  }
};

TEST_F(VerifyPhysics, FindsATubeInTheFloorAndOneOutsideOfTheBin) {
  move_tube({0, 0, -0.01});
  EXPECT_THAT(faults(), Contains(testing::ContainsRegex("A3/2: a tube overlaps the bin by (10\\.|9\\.9)")));
  move_tube({0, 0, 0.01});
  move_tube({2, 0, 0});
  EXPECT_THAT(faults(), Contains(HasSubstr("A3/2: tube 1: its centre of mass, (")));
}

TEST_F(VerifyPhysics, FindsTubesThatOverlap) {
  std::vector<Tube> tubes = read_configuration(path("A3/tube_configurations/2.txt"));
  move_tube(tubes[1].nodes[0].position - tubes[0].nodes[0].position);
  EXPECT_THAT(faults(), Contains(HasSubstr("A3/2: two tubes overlap by ")));
}

TEST_F(VerifyPhysics, FindsByResimulationATubeThatHangsInTheAir) {
  move_tube({0, 0, 0.1});
  EXPECT_THAT(faults(), testing::Not(Contains(HasSubstr("A3/2: "))));
  EXPECT_THAT(faults(true), Contains(testing::ContainsRegex("A3/2: no rest: a node moved [0-9.]+ mm")));
}

TEST_F(VerifyDataset, FindsWhatRunsThatWereCutOffLeft) {
  write_bytes(path("journal-2-of-3.jsonl"), "");
  write_bytes(path("A1/plys/99.ply"), "");
  write_bytes(path("notes.txt"), "of the user");
  EXPECT_THAT(
      faults(),
      ElementsAre(
          "A1/plys/99.ply: not in the manifest",
          "journal-2-of-3.jsonl: its run has ended, but its cases are not in the manifest yet; the same "
          "command resumes it, and --repair completes the manifest"));
}

TEST_F(VerifyDataset, NamesFilesThatLookLikeItsOwnAsNoFault) {
  write_bytes(path("results.jsonl"), "");
  write_bytes(path("splits.json"), "{}");
  write_bytes(path("notes.txt"), "of the user");
  EXPECT_THAT(faults(), IsEmpty());
  std::vector<std::string> where;
  for (const DatasetFault& note : verify().notes) where.push_back(note.where);
  EXPECT_THAT(where, ElementsAre("results.jsonl", "splits.json"));
}

TEST_F(VerifyDataset, ChecksAndMissesOnlyTheWantedCases) {
  std::string manifest = bytes_of(path("manifest.jsonl"));
  write_bytes(path("manifest.jsonl"), manifest.substr(0, manifest.find('\n', manifest.find('\n') + 1) + 1));
  write_bytes(path("A1/plys/2.ply"), "ply\n");
  EXPECT_THAT(faults(), Contains("missing: 4 of 6 cases: A1/3, A3/1-3"));
  const VerifySummary two = verify_dataset(path(), {.wanted = std::vector<CaseId>{{"A", 1, 1}, {"A", 1, 3}}});
  EXPECT_THAT(two.broken, ElementsAre(CaseId{"A", 1, 3}));
  EXPECT_EQ(two.faults.back().what, "1 of 2 cases: A1/3");
  for (const DatasetFault& fault : two.faults) EXPECT_NE(fault.where, "A1/plys/2.ply");
  EXPECT_EQ(test::complaint([&] {
              verify_dataset(path(), {.wanted = std::vector<CaseId>{{"A", 9, 1}}});
            }),
            "wanted: found 'A9/1', expected a case of the recipe");
}

/// A dataset of which one of two shards has been made.
class VerifyHalfADataset : public VerifyDataset {
protected:
  VerifyHalfADataset() {
    generate_dataset(recipe_, part_of({1, 2}, cases(recipe_)), half_, 2, {}, Shard{1, 2});
  }
  VerifySummary verify_half() const { return verify_dataset(half_, {.jobs = 2}); }

  const TemporaryDirectory other_;
  const fs::path half_ = other_ / "half";
};

TEST_F(VerifyHalfADataset, FindsNoFaultWhereARunIsInProgress) {
  const Journal running(half_, "2-of-2");
  write_bytes(half_ / "A1/plys/2.ply", "of a case under way");
  const VerifySummary summary = verify_half();
  EXPECT_TRUE(summary.is_in_progress);
  EXPECT_THAT(summary.faults, IsEmpty());
  EXPECT_THAT(summary.broken, IsEmpty());
  ASSERT_THAT(summary.notes, testing::SizeIs(1));
  EXPECT_EQ(summary.notes[0].where, "journal-2-of-2.jsonl");
  EXPECT_EQ(summary.cases, 3U);

  write_bytes(half_ / "A1/plys/1.ply", "of a finished one");
  write_bytes(half_ / "A1/plys/99.ply", "of none");
  std::vector<std::string> where;
  for (const DatasetFault& fault : verify_half().faults) where.push_back(fault.where);
  EXPECT_THAT(where, ElementsAre("A1/plys/1.ply", "A1/plys/99.ply"));
}

TEST_F(VerifyHalfADataset, IsNotRepairedWhileARunIsInProgress) {
  const VerifySummary before = verify_half();
  const Journal running(half_, "2-of-2");
  EXPECT_EQ(
      test::complaint([&] { repair_dataset(half_, before, 1); }),
      half_.string() +
          ": found a run in progress (journal-2-of-2.jsonl), expected none while a dataset is repaired");
}

TEST_F(VerifyHalfADataset, MissesTheOtherHalfAndTheManifestAndRepairsBoth) {
  const VerifySummary summary = verify_half();
  ASSERT_THAT(summary.faults, testing::SizeIs(2));
  EXPECT_EQ(summary.faults[0].where, "journal-1-of-2.jsonl");
  EXPECT_EQ(summary.faults[1].what, "3 of 6 cases: A1/2, A3/1, A3/3");
  repair_dataset(half_, summary, 2);
  EXPECT_THAT(verify_half().faults, IsEmpty());
  auto repaired = files_below(half_);
  repaired.erase("times.jsonl");
  EXPECT_EQ(repaired, before_);
}

TEST_F(VerifyDataset, FindsCasesThatHaveFailed) {
  std::string manifest = bytes_of(path("manifest.jsonl"));
  write_bytes(path("manifest.jsonl"), manifest.substr(manifest.find('\n') + 1));
  write_bytes(path("failed.jsonl"), to_json(failed_case_of(1, 17, "no luck")) + '\n');
  EXPECT_THAT(faults(), Contains("A1/1: failed: no luck (seed 0000000000000011)"));
  expect_repair();
}

TEST_F(VerifyDataset, FindsARecipeOfOtherScenesButTakesOneThatIsOnlyWrittenOtherwise) {
  replace_in("recipe.toml", "seed = 7\n", "seed = 7  # mine\n");
  EXPECT_THAT(faults(), IsEmpty());
  replace_in("recipe.toml", "seed = 7", "seed = 8");
  EXPECT_THAT(faults(), Contains(HasSubstr("A1/1: seed: found ")));
}

TEST_F(VerifyDataset, FindsAndRepairsADamagedSummary) {
  for (const std::string damage : {"", "{\"cases\":", "{}"}) {
    write_bytes(path("dataset.json"), damage);
    EXPECT_THAT(faults(), ElementsAre(HasSubstr("dataset.json: ")));
    repair_dataset(directory_.path(), verify(), 1);
    EXPECT_THAT(faults(), IsEmpty());
  }
}

TEST_F(VerifyDataset, FindsAndRepairsADamagedLineBesideAGoodOneOfTheSameCase) {
  const std::string manifest = bytes_of(path("manifest.jsonl"));
  write_bytes(path("manifest.jsonl"), manifest + "{\"set\":\"A\",\"tubes\":1,\"case\":2,\"seed\":\"x\"}\n");
  EXPECT_THAT(faults(),
              ElementsAre("manifest.jsonl:7: seed: found 'x', expected a hexadecimal number of 64 bits"));
  expect_repair();
}

TEST_F(VerifyDataset, FindsAndRepairsBytesAfterTheLastLineAndMissingTimes) {
  std::ofstream(path("manifest.jsonl"), std::ios::app) << "torn";
  fs::remove(path("times.jsonl"));
  EXPECT_THAT(faults(), ElementsAre("manifest.jsonl: 4 bytes after the last line", "times.jsonl: missing"));
  expect_repair();
}

TEST_F(VerifyDataset, FindsAndRepairsDamagedTimesAndFailures) {
  std::ofstream(path("times.jsonl"), std::ios::app) << "garbage\n";
  std::ofstream(path("failed.jsonl")) << std::string("\0{}", 3) << "\ntorn";
  EXPECT_THAT(faults(), ElementsAre("failed.jsonl: 4 bytes after the last line",
                                    HasSubstr("failed.jsonl:1: "), HasSubstr("times.jsonl:7: ")));
  expect_repair();
}

TEST_F(VerifyDataset, FindsADirectoryInThePlaceOfAFile) {
  fs::remove(path("A1/plys/2.ply"));
  fs::create_directory(path("A1/plys/2.ply"));
  EXPECT_THAT(faults(), ElementsAre("A1/plys/2.ply: cannot be opened: Is a directory"));
}

TEST_F(VerifyDataset, FindsAndRepairsASeedThatIsNotTheCases) {
  replace_in("manifest.jsonl", "\"seed\":\"", "\"seed\":\"0");
  const std::string manifest = bytes_of(path("manifest.jsonl"));
  const std::size_t end = manifest.find('"', manifest.find("\"seed\":\"") + 8);
  write_bytes(path("manifest.jsonl"), manifest.substr(0, end - 1) + manifest.substr(end));
  EXPECT_THAT(faults(), ElementsAre(HasSubstr("A1/1: seed: found 0")));
  expect_repair();
}

TEST_F(VerifyDataset, DoesNotReadFoldersThatAreLinksToOutside) {
  const TemporaryDirectory elsewhere;
  fs::rename(path("A1"), elsewhere / "A1");
  fs::create_symlink(elsewhere / "A1", path("A1"));
  EXPECT_THAT(faults(), Contains(HasSubstr("A1/plys/1.ply: found a folder that leads to ")));
}

TEST(VerifyManyScanners, FindsNothingWrongButTheNumbersThatAre) {
  const TemporaryDirectory directory;
  std::istringstream text(
      "[bin]\nheight = { min = 0.15, max = 0.25 }\n[output]\ndepths = true\nlabels = true\npcds = true\n"
      "[[scanner]]\nname = \"above\"\nwidth = 120\nheight = 75\n"
      "[[scanner]]\nname = \"beside\"\nwidth = 160\nheight = 100\nsigma = { min = 0, max = 0.001 }\n"
      "position = [0.3, 0.8, 1.2]\nlook_at = [0, 0, 0.1]\n"
      "[[set]]\nname = \"A\"\ntubes = [2]\ncases = 3\n[set.tube]\nradius = 0.0125\nmass = 0.5\n"
      "length = 0.5\nbend_max_deg = 30\n");
  const Recipe recipe = read_recipe(text, "r.toml");
  generate_dataset(recipe, cases(recipe), directory.path(), 2);
  const auto faults = [&] { return verify_dataset(directory.path(), {.jobs = 1, .rest = true}).faults; };
  EXPECT_THAT(faults(), IsEmpty());

  std::string manifest = bytes_of(directory / "manifest.jsonl");
  const std::size_t drawn = manifest.find("\"bin.height\":0.") + 15;
  manifest[drawn] = manifest[drawn] == '1' ? '2' : '1';  // of the first case
  const std::size_t second = manifest.find("\"drawn\":{", manifest.find('\n'));
  manifest.erase(second, manifest.find('}', second) + 2 - second);  // of the second one
  write_bytes(directory / "manifest.jsonl", manifest);
  const std::vector<DatasetFault> found = faults();
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].where, "A2/1");
  EXPECT_THAT(found[0].what, testing::ContainsRegex("^drawn: found bin.height = .*, expected bin.height = "));
  EXPECT_EQ(found[1].where, "A2/2");
  EXPECT_THAT(found[1].what, HasSubstr("drawn: found none, expected bin.height = "));
  repair_dataset(directory.path(), verify_dataset(directory.path(), {}), 1);
  EXPECT_THAT(faults(), IsEmpty());
}

}  // namespace
}  // namespace tanglebin
