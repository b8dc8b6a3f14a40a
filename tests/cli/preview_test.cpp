#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

#include "tanglebin/io/pcd.hpp"
#include "tanglebin/io/ply.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_directory.hpp"

namespace tanglebin {
namespace {

namespace fs = std::filesystem;
using test::ProgramResult;
using testing::HasSubstr;
using testing::StartsWith;

constexpr const char* png_signature = "\x89PNG\r\n\x1a\n";

class Preview : public testing::Test {
protected:
  static constexpr const char* one_tube =
      "1\n"
      "1 2 1\n"
      "1 -0.1 0 0.0125 0.0125\n"
      "2 0.1 0 0.0125 0.0125\n"
      "e_1_2 1 2 1 0.0125 0 0 0.0125 0.7071067811865476 0 0.7071067811865476 0 0.2\n";

  Preview() {
    write("tube.txt", one_tube);
    std::ofstream ply(directory_ / "cloud.ply", std::ios::binary);
    write_ply(ply, cloud());
    std::ofstream pcd(directory_ / "cloud.pcd", std::ios::binary);
    write_pcd(pcd, cloud());
  }

  static PointCloud cloud() {
    PointCloud cloud;
    cloud.points = {{0, 0, 0}, {0.1F, 0, 0}, {0, 0.1F, 0}};
    cloud.labels = {0, 1, 2};
    cloud.width = cloud.points.size();
    return cloud;
  }

  void write(const std::string& name, const std::string& text) const {
    test::write_bytes(directory_ / name, text);
  }

  std::string read(const std::string& name) const { return test::bytes_of(directory_ / name); }

  void remove(const std::string& name) const { fs::remove(directory_ / name); }

  bool exists(const std::string& name) const { return fs::exists(directory_ / name); }

  /// Runs `tanglebin preview` with these arguments, of a shell, in the directory.
  ProgramResult preview(const std::string& arguments) const {
    return test::run_shell("cd " + directory_.path().string() + " && " + TANGLEBIN_PROGRAM + " preview " +
                           arguments);
  }

private:
  test::TemporaryDirectory directory_;
};

TEST_F(Preview, DrawsConfigurationsAndClouds) {
  for (const std::string input : {"tube.txt", "cloud.ply", "cloud.pcd"}) {
    const ProgramResult run = preview(input + " --width 80 --height 60 --out picture.png");
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.out, "");
    EXPECT_EQ(run.err, "");
    EXPECT_THAT(read("picture.png"), StartsWith(png_signature)) << input;
    remove("picture.png");
  }
}

TEST_F(Preview, HasTheSizeAndTheViewpointThatAreAskedFor) {
  ASSERT_EQ(preview("tube.txt --width 80 --height 60 --out a.png").status, 0);
  ASSERT_EQ(preview("tube.txt --width 80 --height 60 --azimuth-deg 20 --out b.png").status, 0);
  ASSERT_EQ(preview("tube.txt --width 80 --height 60 --elevation-deg -90 --out c.png").status, 0);
  write("bin.toml", "[support]\nshape = \"bin\"\npreset = \"published\"\n");
  ASSERT_EQ(preview("tube.txt --width 80 --height 60 --scene bin.toml --out d.png").status, 0);
  write("plane.toml", "[support]\nshape = \"plane\"\n");
  ASSERT_EQ(preview("tube.txt --width 80 --height 60 --scene plane.toml --out e.png").status, 0);
  // The width and the height follow the signature and the head of the first chunk (PNG
  // specification, 11.2.2).
  EXPECT_EQ(read("a.png").substr(16, 8), std::string("\0\0\0\x50\0\0\0\x3c", 8));
  EXPECT_NE(read("a.png"), read("b.png"));
  EXPECT_NE(read("a.png"), read("c.png"));
  EXPECT_NE(read("a.png"), read("d.png"));
  EXPECT_NE(read("a.png"), read("e.png"));
  EXPECT_NE(read("d.png"), read("e.png"));
}

TEST_F(Preview, ReadsStandardInputAndWritesStandardOutput) {
  for (const std::string input : {"tube.txt", "cloud.ply", "cloud.pcd"}) {
    ASSERT_EQ(preview(input + " --width 80 --height 60 --out picture.png").status, 0);
    const ProgramResult run = preview("- --width 80 --height 60 --out - < " + input);
    EXPECT_EQ(run.status, 0);
    EXPECT_EQ(run.out, read("picture.png")) << input;
  }
}

TEST_F(Preview, SaysWhatIsWrongWithItsInputAndExitsWith2) {
  write("empty.txt", "");
  write("story.txt", "Once upon a time");
  write("cut.txt", "1\n1 2 1\n");
  write("empty.ply",
        "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\nproperty float z\n"
        "end_header\n");
  const auto message = [&](const std::string& arguments) {
    const ProgramResult run = preview(arguments + " --out picture.png");
    EXPECT_EQ(run.status, 2) << arguments;
    EXPECT_FALSE(exists("picture.png")) << arguments;
    EXPECT_EQ(std::ranges::count(run.err, '\n'), 1) << run.err;
    return run.err;
  };
  EXPECT_THAT(message("absent.txt"), StartsWith("tanglebin: absent.txt: cannot be opened: No such file"));
  EXPECT_THAT(message("."), StartsWith("tanglebin: .: is a directory"));
  EXPECT_THAT(message("empty.txt"),
              StartsWith("tanglebin: empty.txt: found an empty file, expected a config"));
  EXPECT_THAT(message("story.txt"),
              StartsWith("tanglebin: story.txt: found 'O' at the start, expected a config"));
  EXPECT_THAT(message("cut.txt"), StartsWith("tanglebin: cut.txt:"));
  EXPECT_THAT(message("empty.ply"), HasSubstr("empty.ply: found a cloud without points"));
  EXPECT_THAT(message("- < story.txt"), StartsWith("tanglebin: standard input: found 'O' at the start"));
  EXPECT_THAT(preview("tube.txt --out p.jpg").err,
              HasSubstr("--out: found 'p.jpg', expected a name that ends in .png"));
  EXPECT_THAT(
      message("tube.txt --scene round.toml"),
      HasSubstr("--scene: found nothing called 'round.toml', expected a scene file, a recipe, a dataset"));
  EXPECT_THAT(message("tube.txt --elevation-deg 100"),
              HasSubstr("elevation: found 100°, expected -90° to 90°"));
}

TEST_F(Preview, SaysWhereItCannotWrite) {
  const ProgramResult run = preview("tube.txt --width 8 --height 8 --out absent/picture.png");
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, HasSubstr("absent/picture.png: cannot write: No such file or directory"));
  const ProgramResult full = preview("tube.txt --width 8 --height 8 --out - >/dev/full");
  EXPECT_EQ(full.status, 5);
  EXPECT_THAT(full.err, HasSubstr("standard output: cannot write"));
}

TEST_F(Preview, ExitsWith64WhereItIsNotCalledAsItsHelpSays) {
  EXPECT_EQ(preview("").status, 64);
  EXPECT_EQ(preview("tube.txt").status, 64);
  EXPECT_EQ(preview("tube.txt --out a.png --width wide").status, 64);
  EXPECT_THAT(preview("tube.txt --out a.png --width 0").err,
              HasSubstr("--width: found '0', expected a whole number from 1 to 4096"));
  EXPECT_THAT(preview("tube.txt --out a.png --azimuth-deg 1e999").err,
              HasSubstr("--azimuth-deg: found '1e999', expected a number\n"));
  EXPECT_EQ(preview("tube.txt --out a.png --colour").status, 64);
}

TEST_F(Preview, HelpHasAnExample) {
  const ProgramResult run = preview("--help");
  EXPECT_EQ(run.status, 0);
  EXPECT_THAT(run.out, HasSubstr("tanglebin preview dataset/"));
}

}  // namespace
}  // namespace tanglebin
