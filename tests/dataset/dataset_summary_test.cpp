#include "tanglebin/dataset/dataset_summary.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tanglebin/dataset/generate_dataset.hpp"
#include "tests/dataset/small_recipe.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/temporary_directory.hpp"

namespace tanglebin {
namespace {

using test::bytes_of;
using test::complaint;
using test::small_recipe;
using test::TemporaryDirectory;
using test::write_bytes;
using testing::HasSubstr;

TEST(Digest, IsThatOfSha256SumsLines) {
  Digest digest;
  CaseRecord record{};
  record.files = {{"A1/plys/1.ply", 3, "abc"}, {"A1/b/1.txt", 3, "def"}};
  digest.add(record);
  record.files = {{"A1/plys/2.ply", 3, "012"}};
  digest.add(record);
  EXPECT_EQ(digest.files(), 3U);
  // printf 'abc  A1/plys/1.ply\ndef  A1/b/1.txt\n012  A1/plys/2.ply\n' | sha256sum
  EXPECT_EQ(digest.hex(), "e042ef291d38f909524c0e4a0b06590de44dd10dc2e76f133b03480f3c7a315f");
}

TEST(DatasetSummary, ReadsBackAsItWas) {
  const TemporaryDirectory directory;
  const DatasetSummary summary{.cases = 3,
                               .recipe_cases = 5,
                               .failed = 1,
                               .files = 9,
                               .digest = "0123",
                               .made_with = {{{"ode", "0.16.2"}, {"glibc", "2.36"}}, {{"ode", "0.17"}}}};
  write_bytes(directory / "dataset.json", to_json(summary));
  const std::optional<DatasetSummary> back = read_dataset_summary(directory.path());
  ASSERT_TRUE(back);
  EXPECT_EQ(to_json(*back), to_json(summary));
  EXPECT_FALSE(back->is_complete());
}

TEST(DatasetSummary, IsNoneWhereThereIsNoFileAndAnErrorWhereItIsDamaged) {
  const TemporaryDirectory directory;
  EXPECT_FALSE(read_dataset_summary(directory.path()));
  write_bytes(directory / "dataset.json", "{\"cases\":");
  EXPECT_THAT(complaint([&] { read_dataset_summary(directory.path()); }), HasSubstr("dataset.json: "));
  std::filesystem::remove(directory / "dataset.json");
  std::filesystem::create_directory(directory / "dataset.json");
  EXPECT_THAT(complaint([&] { read_dataset_summary(directory.path()); }),
              HasSubstr("dataset.json: found a directory, expected a regular file"));
}

TEST(DatasetSummary, SaysWhatTheBytesFollowFromBesideTheRecipe) {
  const Versions here = versions();
  for (const char* name :
       {"tanglebin", "compiler", "ode", "embree", "eigen", "boost", "libpng", "zlib", "glibc", "machine"}) {
    ASSERT_TRUE(here.contains(name)) << name;
    EXPECT_NE(here.at(name), "") << name;
  }
}

// What the recipes of this project make, byte for byte. Another digest means that everybody's datasets
// change: where that is wanted, the changelog says so and what users must do (docs/determinism.md).
class StoredDigest : public testing::Test {
protected:
  static std::string digest_of(const Recipe& recipe) {
    const TemporaryDirectory directory;
    return generate_dataset(recipe, cases(recipe), directory.path(), 2).dataset->digest;
  }
};

TEST_F(StoredDigest, OfChainsWithEveryFormat) {
  Recipe recipe = small_recipe();
  recipe.output = {.bin_points = true, .worlds = true, .pcds = true, .depths = true, .labels = true};
  EXPECT_EQ(digest_of(recipe), "a9a6a04758236f64be823e036683e3b140313dbaa15bd25853d228982189241e");
}

TEST_F(StoredDigest, OfTrees) {
  Recipe recipe = read_recipe(std::filesystem::path(TANGLEBIN_SOURCE) / "recipes/set-c.toml");
  recipe.camera = small_recipe().camera;
  recipe.sets[0].tubes = {2};
  recipe.sets[0].cases = 2;
  EXPECT_EQ(digest_of(recipe), "e42bc208b61263c08a79a3615c3704110a4f7bd4765e84f6d4c9163f397a3af9");
}

TEST_F(StoredDigest, OfAHeapInTheFullPicture) {
  Recipe recipe = read_recipe(std::filesystem::path(TANGLEBIN_SOURCE) / "recipes/paper.toml");
  for (SetRecipe& set : recipe.sets) {
    set.tubes = {10};
    set.cases = 1;
  }
  EXPECT_EQ(digest_of(recipe), "01447e1dc54bf6e1a9fd862ac099aaa8e9e4f659fe71ce6cc26724ec17d481df");
}

}  // namespace
}  // namespace tanglebin
