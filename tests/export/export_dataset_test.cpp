#include "tanglebin/export/export_dataset.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <ostream>
#include <sstream>
#include <string>

#include "tanglebin/dataset/generate_dataset.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_directory.hpp"

namespace tanglebin {

// How googletest prints it.
static void PrintTo(ExportFormat format, std::ostream* out) {
  *out << name_of(format);
}

namespace {

using test::complaint;
using test::files_below;
using test::TemporaryDirectory;
using test::write_bytes;
using testing::HasSubstr;

// Six scenes of one and four tubes, seen by an ideal scanner and by one that looks over a wall, blurs edges
// and loses pixels.
Recipe two_scanners() {
  std::istringstream in(R"(
seed = 5
[[scanner]]
name = "above"
width = 240
height = 150
[[scanner]]
name = "beside"
width = 200
height = 150
position = [0.3, 0.8, 0.9]
look_at = [0, 0, 0.05]
edges = "mix"
dropout = 0.05
sigma = 0.001
[output]
worlds = false
depths = true
labels = true
occlusions = true
[[set]]
name = "A"
tubes = [1, 4]
cases = 3
tube = { radius = 0.0125, mass = 0.5, length = 0.5, bend_max_deg = 45 }
)");
  return read_recipe(in, "recipe.toml");
}

/// A dataset that all tests read.
const Dataset& dataset() {
  static const TemporaryDirectory directory;
  static const Dataset made = [] {
    const Recipe recipe = two_scanners();
    generate_dataset(recipe, cases(recipe), directory.path(), 2);
    return read_dataset(directory.path());
  }();
  return made;
}

ExportRequest request(ExportFormat format, const std::filesystem::path& directory) {
  return {.format = format, .wanted = cases(dataset()), .directory = directory};
}

class EveryFormat : public testing::TestWithParam<ExportFormat> {};
INSTANTIATE_TEST_SUITE_P(Export, EveryFormat, testing::ValuesIn(export_formats()),
                         [](const auto& format) { return name_of(format.param); });

TEST_P(EveryFormat, GivesAForeignReaderTheDatasetPixelForPixel) {
  const std::string python = "PATH=/usr/bin:/bin python3 ";
  if (test::run_shell(python + "-c 'import h5py, numpy, PIL'").status != 0)
    GTEST_SKIP() << "python3-h5py, python3-numpy or python3-pil is missing";
  const TemporaryDirectory out;
  const ExportSummary summary = export_dataset(dataset(), request(GetParam(), out.path()));
  EXPECT_TRUE(summary.is_complete);
  EXPECT_EQ(summary.progress.made, 6U);
  const auto check =
      test::run_shell(python + TANGLEBIN_SOURCE + "/tests/export/check_export.py " + name_of(GetParam()) +
                      " " + dataset().directory.string() + " " + out.path().string());
  EXPECT_EQ(check.status, 0) << check.err;
}

TEST_P(EveryFormat, HasTheSameBytesInOneRunInShardsAndAfterAnInterruption) {
  const TemporaryDirectory one;
  const TemporaryDirectory parts;
  export_dataset(dataset(), request(GetParam(), one.path()));
  for (const int index : {2, 1}) {
    ExportRequest part = request(GetParam(), parts.path());
    part.shard = Shard{index, 2};
    part.jobs = 2;
    EXPECT_EQ(export_dataset(dataset(), part).is_complete, index == 1);
  }
  const auto whole = files_below(one.path());
  EXPECT_EQ(files_below(parts.path()), whole);

  // As if some had been removed, among them one of several of a case and one that is about all cases.
  for (const auto& [path, bytes] : whole) {
    const bool is_removed = path.ends_with("above/1.npz") || path.ends_with("1.hdf5") ||
                            path.ends_with(".tar") || path == "depth/A4-000002-beside.png" ||
                            path.starts_with("annotations/") || path.starts_with("train/000002") ||
                            path == "models/obj_000007.ply" || path == "models/models_info.json";
    if (is_removed) std::filesystem::remove(one / path);
  }
  const ExportSummary resumed = export_dataset(dataset(), request(GetParam(), one.path()));
  EXPECT_GT(resumed.progress.made, 0U);
  EXPECT_TRUE(resumed.is_complete);
  EXPECT_EQ(files_below(one.path()), whole);
  EXPECT_EQ(export_dataset(dataset(), request(GetParam(), one.path())).progress.found, 6U);
}

TEST(Export, LeavesNothingOfARunThatWasKilled) {
  const TemporaryDirectory out;
  const ExportRequest numpy = request(ExportFormat::numpy, out.path());
  export_dataset(dataset(), numpy);
  const auto whole = files_below(out.path());
  // It wrote the index when it was killed: the first, or, of an export that is complete, the last.
  for (const char* staging : {".journal.unfinished", ".assembling.unfinished"}) {
    std::filesystem::create_directory(out / staging);
    write_bytes(out / staging / ".tanglebin-1-0.tmp", "half");
    EXPECT_TRUE(export_dataset(dataset(), numpy).is_complete);
    EXPECT_EQ(files_below(out.path()), whole) << staging;
    EXPECT_FALSE(std::filesystem::exists(out / staging));
  }
}

TEST(Export, KeepsOutOfADirectoryThatIsNotItsOwn) {
  const TemporaryDirectory out;
  const ExportRequest whole = request(ExportFormat::numpy, out.path());
  export_dataset(dataset(), whole);
  ExportRequest other = whole;
  other.format = ExportFormat::hdf5;
  EXPECT_THAT(
      complaint([&] { export_dataset(dataset(), other); }),
      HasSubstr("export.json: format: found \"numpy\", expected \"hdf5\"; the directory has another export"));
  ExportRequest fewer = whole;
  fewer.wanted.pop_back();
  EXPECT_THAT(complaint([&] { export_dataset(dataset(), fewer); }), HasSubstr("cases: found 6, expected 5"));
  ExportRequest into_dataset = whole;
  into_dataset.directory = dataset().directory;
  EXPECT_THAT(complaint([&] { export_dataset(dataset(), into_dataset); }),
              HasSubstr("expected an export or an empty directory"));
}

TEST(Export, SaysWhatIsWrongWithTheDataset) {
  const TemporaryDirectory directory;
  const TemporaryDirectory out;
  Recipe recipe = two_scanners();
  recipe.sets[0].cases = 1;
  generate_dataset(recipe, cases(recipe), directory.path(), 1);
  const Dataset own = read_dataset(directory.path());
  const ExportRequest numpy{.format = ExportFormat::numpy, .wanted = cases(own), .directory = out / "export"};
  write_bytes(directory / "A1/tube_configurations/1.txt", "0\n");
  EXPECT_THAT(complaint([&] { export_dataset(own, numpy); }), HasSubstr("as the manifest says"));
  std::filesystem::remove(directory / "dataset.json");
  EXPECT_THAT(
      complaint([&] { export_dataset(own, numpy); }),
      HasSubstr("dataset.json: found missing, expected a dataset of which `tanglebin generate` has ended"));
}

}  // namespace
}  // namespace tanglebin
