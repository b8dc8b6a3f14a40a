#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tanglebin/io/configuration.hpp"
#include "tanglebin/io/images.hpp"
#include "tanglebin/io/pcd.hpp"
#include "tanglebin/io/ply.hpp"
#include "tanglebin/io/read_cloud.hpp"
#include "tanglebin/scan/scan_output.hpp"
#include "tanglebin/score/score.hpp"
#include "tests/model/scene/scanned.hpp"
#include "tests/support/program.hpp"
#include "tests/support/recipe_text.hpp"

namespace tanglebin {
namespace {

using test::ProgramResult;
using test::run_program;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::UnorderedElementsAre;

/// Two tubes that cross, scanned.
class ModelCommand : public testing::Test {
protected:
  ModelCommand() {
    write("scan.ply", ply_of(scan_));
    std::ostringstream text;
    write_configuration(text, tubes_);
    write("truth.txt", text.str());
  }

  static std::string ply_of(const PointCloud& cloud) {
    std::ostringstream out;
    write_ply(out, cloud);
    return out.str();
  }
  std::string path(const std::string& name) const { return (directory_ / name).string(); }
  void write(const std::string& name, const std::string& bytes) const {
    test::write_bytes(directory_ / name, bytes);
  }
  ProgramResult model(const std::string& cloud, const std::string& options) const {
    return run_program("model " + path(cloud) + paper + " --out " + path("labelled.ply") + " " + options);
  }
  ProgramResult model_without_scene(const std::string& cloud, const std::string& options) const {
    return run_program("model " + path(cloud) + " --out " + path("labelled.ply") + " " + options);
  }

  static inline const std::string paper = " --scene " TANGLEBIN_SOURCE "/scenes/paper.toml";

  std::vector<Tube> tubes_ = {
      test::chain(1, 0.0125, {{-0.2, 0, 0.0125}, {0, 0.02, 0.0125}, {0.2, 0, 0.0125}}),
      test::chain(2, 0.0125, {{0.03, -0.15, 0.0125}, {0.03, 0, 0.06}, {0.03, 0.15, 0.0125}})};
  PointCloud scan_ = test::scanned(tubes_);
  test::TemporaryDirectory directory_;
};

TEST_F(ModelCommand, WritesThePointsWithLabelsAndTheTubes) {
  const ProgramResult run = model("scan.ply", "--downsample 0.5 --modelled-tubes " + path("tubes.txt"));
  ASSERT_EQ(run.status, 0) << run.err;
  for (const char* step : {"filter", "vote", "fragment", "join", "fit", "label"})
    EXPECT_THAT(run.out, HasSubstr(step));
  const PointCloud labelled = read_cloud(directory_ / "labelled.ply");
  EXPECT_EQ(labelled.points, scan_.points);
  EXPECT_EQ(read_configuration(directory_ / "tubes.txt").size(), 2U);

  const ProgramResult score =
      run_program("score --json --truth " + path("scan.ply") + " --labelled " + path("labelled.ply") +
                  " --true-tubes " + path("truth.txt") + " --modelled-tubes " + path("tubes.txt"));
  ASSERT_EQ(score.status, 0) << score.err;
  const auto json = nlohmann::json::parse(score.out);
  EXPECT_GT(json.at("micro_recall"), 0.98);
  EXPECT_LT(json.at("centre_line_error"), 0.001);
}

TEST_F(ModelCommand, PrintsItsStepsAsJson) {
  const ProgramResult run = model("scan.ply", "--json");
  ASSERT_EQ(run.status, 0) << run.err;
  const auto json = nlohmann::json::parse(run.out);
  EXPECT_EQ(json.at("points"), scan_.points.size());
  EXPECT_EQ(json.at("tubes"), 2);
  std::vector<std::string> keys;
  for (const auto& [key, value] : json.items()) keys.push_back(key);
  EXPECT_THAT(keys, UnorderedElementsAre("cloud", "points", "radii", "tubes", "steps", "notes", "usable",
                                         "counts", "findings", "estimated_lengths", "found"))
      << "docs/formats.md lists them";
  std::vector<std::string> names;
  for (const auto& step : json.at("steps")) names.push_back(step.at("name"));
  EXPECT_THAT(names, ElementsAre("filter", "vote", "fragment", "join", "fit", "label"));
}

TEST_F(ModelCommand, ReadsAPipeAndWritesOne) {
  const ProgramResult run = run_program("model - --out -" + paper, ply_of(scan_));
  ASSERT_EQ(run.status, 0) << run.err;
  std::istringstream in(run.out);
  EXPECT_EQ(read_cloud(in, "output").points, scan_.points);
}

TEST_F(ModelCommand, PrintsNothingBesideTubesOnStandardOutput) {
  const ProgramResult run = model("scan.ply", "--modelled-tubes -");
  ASSERT_EQ(run.status, 0) << run.err;
  std::istringstream in(run.out);
  EXPECT_EQ(read_configuration(in, "output").size(), 2U);
}

TEST_F(ModelCommand, KeepsAnOrganizedCloudWithItsHoles) {
  const KnownScene scene = test::paper_scene();
  const PointCloud organized =
      organized_cloud_from_scan(scan(tubes_, scene.support.bin, scene.camera), CloudOf::tubes_and_bin, 2);
  write("scan.pcd", [&] {
    std::ostringstream pcd;
    write_pcd(pcd, organized);
    return pcd.str();
  }());
  for (const std::string out : {"labelled.ply", "labelled.pcd"}) {
    ASSERT_EQ(run_program("model " + path("scan.pcd") + paper + " --out " + path(out)).status, 0);
    const PointCloud labelled = read_cloud(directory_ / out);
    EXPECT_EQ(labelled.width, organized.width);
    EXPECT_EQ(labelled.height, organized.height);
    for (std::size_t i = 0; i < organized.points.size(); ++i) {
      const bool is_there = organized.points[i].allFinite();
      ASSERT_EQ(labelled.points[i].allFinite(), is_there) << i;
      if (!is_there) {
        ASSERT_EQ(labelled.labels[i], null_label) << i;
      }
    }
  }
}

TEST_F(ModelCommand, KeepsWhatTheScannerMeasuredAndItsColours) {
  PointCloud measured = scan_;
  measured.labels.clear();
  for (std::size_t i = 0; i < measured.points.size(); ++i) {
    measured.colors[i] = {static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(i / 256), 99};
    measured.intensities.push_back(static_cast<float>(i));
    measured.normals.emplace_back(0, 0, 1);
  }
  write("measured.ply", ply_of(measured));
  ASSERT_EQ(model("measured.ply", "").status, 0);
  const PointCloud labelled = read_cloud(directory_ / "labelled.ply");
  EXPECT_EQ(labelled.colors, measured.colors);
  EXPECT_EQ(labelled.intensities, measured.intensities);
  EXPECT_EQ(labelled.normals, measured.normals);
  EXPECT_GT(score(scan_.labels, labelled.labels).micro_recall, 0.98);
}

TEST_F(ModelCommand, DrawsWhatEachStepLeft) {
  const std::map<std::string, std::vector<std::string>> pictures_of = {
      {"paper", {"1-filtered", "2-segmented", "3-fitted", "4-joined", "5-labelled"}},
      {"axis", {"1-filtered", "2-votes", "3-joined", "4-labelled"}}};
  for (const auto& [method, names] : pictures_of) {
    ASSERT_EQ(
        model("scan.ply", "--method " + method + " --downsample 0.3 --debug-dir " + path(method)).status, 0);
    for (const std::string& name : names) {
      const std::string png = test::bytes_of(directory_ / method / (name + ".png"));
      EXPECT_TRUE(png.starts_with("\x89PNG")) << method << " " << name;
    }
  }
}

TEST_F(ModelCommand, OfAnEmptyCloudWritesAnEmptyOne) {
  write("empty.ply", ply_of({}));
  const ProgramResult run =
      model("empty.ply", "--modelled-tubes " + path("tubes.txt") + " --debug-dir " + path("steps"));
  EXPECT_EQ(run.status, 6);
  EXPECT_THAT(run.err, HasSubstr("empty.ply: the cloud has no points"));
  EXPECT_TRUE(read_cloud(directory_ / "labelled.ply").points.empty());
  EXPECT_EQ(test::bytes_of(directory_ / "tubes.txt"), "0\n");
}

TEST_F(ModelCommand, EstimatesTheRadius) {
  const ProgramResult run = model("scan.ply", "--radius auto --json");
  ASSERT_EQ(run.status, 0) << run.err;
  const auto json = nlohmann::json::parse(run.out);
  EXPECT_NEAR(json.at("radii").at(0), 0.0125, 0.02 * 0.0125);
  EXPECT_EQ(json.at("tubes"), 2);
  EXPECT_THAT(run.err, HasSubstr("the radius is estimated: 0.012"));

  write("empty.ply", ply_of(test::scanned({})));
  const ProgramResult nothing = model("empty.ply", "--radius auto");
  EXPECT_EQ(nothing.status, 2);
  EXPECT_THAT(nothing.err, HasSubstr("radius: "));
}

TEST_F(ModelCommand, TakesTubesOfSeveralRadiiAndLengths) {
  const std::vector<Tube> tubes = {test::chain(1, 0.008, {{-0.2, 0.1, 0.008}, {0.1, 0.1, 0.008}}),
                                   test::chain(2, 0.0125, {{-0.2, -0.1, 0.0125}, {0.2, -0.1, 0.0125}})};
  const PointCloud cloud = test::scanned(tubes);
  write("mixed.ply", ply_of(cloud));
  const ProgramResult run = model(
      "mixed.ply", "--radius 0.008,0.0125 --length 0.3,0.4 --json --modelled-tubes " + path("tubes.txt"));
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(nlohmann::json::parse(run.out).at("radii"), nlohmann::json::parse("[0.008, 0.0125]"));
  const std::vector<Tube> found = read_configuration(directory_ / "tubes.txt");
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].radius, 0.008);
  EXPECT_EQ(found[1].radius, 0.0125);
  EXPECT_GT(score(cloud.labels, read_cloud(directory_ / "labelled.ply").labels).micro_recall, 0.999);
}

TEST_F(ModelCommand, LeavesNothingBehindWhereAnOutputCannotBeWritten) {
  for (const std::string& option :
       {"--modelled-tubes " + path("none/tubes.json"), "--mesh " + path("none/m.ply")}) {
    const ProgramResult result = model("scan.ply", option);
    EXPECT_EQ(result.status, 2);
    EXPECT_THAT(result.err, HasSubstr("cannot write: No such file or directory"));
    EXPECT_FALSE(std::filesystem::exists(path("labelled.ply"))) << option;
  }
}

TEST_F(ModelCommand, DoesNotOverwriteADatasetsFiles) {
  const std::string recipe = test::recipe_text({.seed = 3, .width = 480, .tubes = "[1]", .cases = 1});
  ASSERT_EQ(run_program("generate - --out " + path("dataset"), recipe).status, 0);
  std::filesystem::create_directory_symlink("dataset/A1", directory_ / "link");
  const auto write_to = [&](const std::string& out) {
    return run_program("model " + path("scan.ply") + paper + " --out " + path(out));
  };
  const std::string before = test::bytes_of(path("dataset/A1/plys/1.ply"));
  for (const std::string out : {"dataset/A1/plys/1.ply", "link/plys/1.ply"}) {
    const ProgramResult run = write_to(out);
    EXPECT_EQ(run.status, 2) << out;
    EXPECT_THAT(run.err,
                AllOf(HasSubstr("--out: found '"), HasSubstr("which is a file of a dataset, expected")));
  }
  EXPECT_EQ(run_program("locate " + path("scan.ply") + " --out " + path("dataset/recipe.toml")).status, 2);
  EXPECT_EQ(test::bytes_of(path("dataset/A1/plys/1.ply")), before);
  EXPECT_EQ(write_to("dataset/A1/plys/labelled.ply").status, 0);
}

// By whatever path.
TEST_F(ModelCommand, DoesNotOverwriteItsInput) {
  std::filesystem::create_symlink("scan.ply", directory_ / "link.ply");
  write("scene.toml", "");
  const std::string before = test::bytes_of(path("scan.ply"));
  for (const std::string out : {"scan.ply", "./scan.ply", "link.ply"}) {
    const ProgramResult run = run_program("model " + path("scan.ply") + paper + " --out " + path(out));
    EXPECT_EQ(run.status, 2) << out;
    EXPECT_THAT(run.err,
                HasSubstr("--out: found '" + path(out) + "', which is also an input, expected another name"));
  }
  const ProgramResult mesh = model("scan.ply", "--mesh " + path("link.ply"));
  EXPECT_EQ(mesh.status, 2);
  EXPECT_THAT(mesh.err, HasSubstr("--mesh: found '"));
  const std::string scene = path("scene.toml");
  const ProgramResult located =
      run_program("locate " + path("scan.ply") + " --scene " + scene + " --out " + scene);
  EXPECT_EQ(located.status, 2);
  EXPECT_THAT(located.err, HasSubstr("which is also an input"));
  EXPECT_EQ(test::bytes_of(path("scan.ply")), before);
}

TEST_F(ModelCommand, RefusesWhatItCannotModel) {
  const std::vector<std::pair<ProgramResult, std::string>> refusals = {
      {model("scan.ply", "--radius 8"), "--radius: found 8 m, expected 0.0001 to 1 m; for 8 mm write 0.008"},
      {model("scan.ply", "--radius 0.2"), "--radius: found 0.2 m, expected less than 0.185 m"},
      {model("scan.ply", "--length 80"), "--length: found 80 m, expected at most 6.92 m"},
      {model("scan.ply", "--downsample 0.1,0.2"), "--downsample: found 2 ratios, expected one"},
      {model("scan.ply", "--modelled-tubes tubes.ply"),
       "--modelled-tubes: found 'tubes.ply', expected a name that ends in .txt or .json"},
      {run_program("model " + path("scan.ply") + " --out labelled.xyz"),
       "--out: found 'labelled.xyz', expected a name that ends in .ply or .pcd"},
      {model("scan.ply", "--method magic"), "--method: found 'magic', expected one of paper, axis"},
      {model("scan.ply", "--downsample 0"),
       "--downsample: found '0', expected a ratio above 0 and at most 1"},
      {model("scan.ply", "--radius -1"), "--radius: found '-1', expected a positive number, or auto alone"},
      {model("scan.ply", "--radius 0.01,"), "--radius: found '', expected a positive number, or auto alone"},
      {model("scan.ply", "--radius auto,0.005"),
       "--radius: found 'auto', expected a positive number, or auto alone"},
      {model("scan.ply", "--length auto"),
       "--length: found 'auto', expected a positive number, or unknown alone"},
      {model("scan.ply", "--radius 0.01,0.01"), "--radius: found 0.01 m for two kinds"},
      {model("scan.ply", "--radius 0.01,0.02,0.03 --length 0.4,0.5"),
       "--length: found 2 lengths, expected one, or one for each radius: 3"},
      {model("scan.ply", "--tree 1-2:0.3,1-3"),
       "--tree: found '1-3', expected a segment with its length in metres, such as 1-2:0.3"},
      {model("scan.ply", "--tree 1-2:0.3,2-1:0.1"), "--tree: found a segment to node 1, which closes a loop"},
      {model("scan.ply", "--tree 1-2:80"), "--tree: found 80 m, expected at most 6.92 m"},
      {model("scan.ply", "--tree 1-2:0.3 --tree 1-2:0.4"),
       "--tree: found 2 trees, expected one, or one for each radius: 1"},
      {model("scan.ply", "--radius 0.01,0.02 --method paper"),
       "--method: the paper's method handles a single radius"},
      {model_without_scene("scan.ply", ""),
       "scan.ply: camera: found neither the camera's intrinsics nor an organized cloud, which shows them, "
       "expected --camera FILE"},
      {model_without_scene("scan.ply", "--scene bucket.toml"), "--scene: found nothing called 'bucket.toml'"},
      {model("scan.ply", "--frame robot"), "--frame: found 'robot', expected camera or world"},
      {model("scan.ply", "--unit cm"), "--unit: found 'cm', expected m or mm"},
      {model("scan.ply", "--camera nowhere.json"), "nowhere.json: cannot be opened"},
      {model("nowhere.ply", ""), "nowhere.ply"},
  };
  for (const auto& [run, message] : refusals) {
    EXPECT_EQ(run.status, 2) << message;
    EXPECT_THAT(run.err, HasSubstr(message));
  }
  EXPECT_FALSE(std::filesystem::exists(directory_ / "labelled.ply"));
  EXPECT_EQ(run_program("model " + path("scan.ply")).status, 64);
}

// The cloud shows that the length is wrong, but it is not the cloud that has it.
TEST_F(ModelCommand, ErrorsNameWhatGaveTheValue) {
  const std::string plane =
      "[camera]\npreset = \"paper\"\nframe = \"world\"\n[support]\nshape = \"plane\"\n[[tube]]\n";
  write("long.toml", plane + "radius = 0.0125\nlength = 500\n");
  write("open.toml", plane + "length = 0.5\n[[tube]]\nradius = 0.02\n");
  const auto complaint = [&](const std::string& options) {
    return model_without_scene("scan.ply", "--scene " + path(options)).err;
  };
  EXPECT_THAT(complaint("long.toml"),
              HasSubstr("tanglebin: " + path("long.toml:8") + ": tube[0].length: found 500 m, expected"));
  EXPECT_THAT(complaint("long.toml --length 300"), HasSubstr("tanglebin: --length: found 300 m, expected"));
  EXPECT_THAT(complaint("long.toml --radius 0.3"),
              HasSubstr("tanglebin: " + path("long.toml:8") + ": tube[0].length: found 500 m"));
  EXPECT_THAT(complaint("open.toml"),
              HasSubstr("tanglebin: " + path("open.toml:6") + ": tube[0].radius: found 2 classes of tubes"));
}

TEST_F(ModelCommand, FindsOutWhatAnOrganizedCloudShows) {
  const KnownScene scene = test::paper_scene();
  const PointCloud organized =
      organized_cloud_from_scan(scan(tubes_, scene.support.bin, scene.camera), CloudOf::tubes, 2);
  std::ostringstream pcd;
  write_pcd(pcd, organized);
  write("scan.pcd", pcd.str());
  const ProgramResult run = model_without_scene("scan.pcd", "--radius 0.0125 --json");
  ASSERT_EQ(run.status, 0) << run.err;
  const auto json = nlohmann::json::parse(run.out);
  EXPECT_EQ(json.at("tubes"), 2);
  for (const char* note :
       {"VIEWPOINT", "in the world frame", "fitted to the organized cloud", "a bin or a floor"}) {
    EXPECT_THAT(run.err, HasSubstr(note));
    EXPECT_THAT(json.at("notes").dump(), HasSubstr(note));
  }
}

TEST_F(ModelCommand, TakesACameraFileAndACloudInMillimetresInTheCamerasFrame) {
  const Camera camera = test::paper_scene().camera;
  PointCloud seen = scan_;
  for (Eigen::Vector3f& point : seen.points)
    point = (1000 * (camera.pose.inverse() * point.cast<double>())).cast<float>();
  write("seen.ply", ply_of(seen));
  write("camera.json", camera_json(camera));
  write("scene.toml",
        "[support]\nshape = \"bin\"\npreset = \"paper\"\n[[tube]]\nradius = 0.0125\nlength = 0.5\n");
  const ProgramResult run =
      model_without_scene("seen.ply", "--scene " + path("scene.toml") + " --camera " + path("camera.json") +
                                          " --frame camera --unit mm");
  ASSERT_EQ(run.status, 0) << run.err;
  const PointCloud labelled = read_cloud(directory_ / "labelled.ply");
  EXPECT_EQ(labelled.points, seen.points);  // as they came
  EXPECT_GT(score(scan_.labels, labelled.labels).micro_recall, 0.99);
}

TEST_F(ModelCommand, TakesADepthImageWithItsCamera) {
  const KnownScene scene = test::paper_scene();
  const Scan seen = scan(tubes_, scene.support.bin, scene.camera);
  write("depth.png", depth_png(depth_image(seen)));
  write("camera.json", camera_json(scene.camera));
  write("scene.toml",
        "[support]\nshape = \"bin\"\npreset = \"paper\"\n[[tube]]\nradius = 0.0125\nlength = 0.5\n");
  const std::string options = "--scene " + path("scene.toml") + " --camera " + path("camera.json");
  const ProgramResult run = model_without_scene("depth.png", options);
  ASSERT_EQ(run.status, 0) << run.err;
  const PointCloud labelled = read_cloud(directory_ / "labelled.ply");
  EXPECT_EQ(labelled.points.size(), 1920U * 1200U);
  const PointCloud truth = organized_cloud_from_scan(seen, CloudOf::tubes_and_bin, 2);
  EXPECT_GT(score(truth.labels, labelled.labels).micro_recall, 0.98);

  EXPECT_THAT(model_without_scene("depth.png", "--scene " + path("scene.toml")).err,
              HasSubstr("depth.png: camera: found a depth image, and nothing of the camera that took it"));
  write("ros.yaml", "width: 1920\nheight: 1200\nk: [1372, 0, 959.5, 0, 1372, 599.5, 0, 0, 1]\n");
  EXPECT_THAT(
      model_without_scene("depth.png", "--camera " + path("ros.yaml")).err,
      HasSubstr("depth_scale: found nothing that says what the image's numbers are, expected --unit mm"));
  write("small.yaml", "width: 960\nheight: 600\nk: [686, 0, 479.5, 0, 686, 299.5, 0, 0, 1]\n");
  EXPECT_THAT(model_without_scene("depth.png", "--unit mm --camera " + path("small.yaml")).err,
              HasSubstr("depth.png: "));
}

TEST_F(ModelCommand, TakesTheSceneOfADatasetsCase) {
  const std::string recipe = test::recipe_text({.seed = 3, .width = 480, .tubes = "[2]", .cases = 1}) +
                             "[bin]\nlength = 0.7\nwidth = 0.5\nheight = 0.1\n";
  ASSERT_EQ(run_program("generate - --out " + path("dataset"), recipe).status, 0);
  const std::string cloud = path("dataset/A2/plys/1.ply");
  const auto labels_by = [&](const std::string& file, const std::string& scene) {
    const std::string out = path("labelled.ply");
    const ProgramResult run = run_program("model " + file + " --out " + out + " --scene " + scene);
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_THAT(run.err, HasSubstr("points lie across a tube"));  // the camera is coarse
    return read_cloud(std::filesystem::path(out)).labels;
  };
  const auto labels = labels_by(cloud, path("dataset"));
  EXPECT_GT(score(read_cloud(std::filesystem::path(cloud)).labels, labels).micro_recall, 0.9);
  std::filesystem::copy(cloud, path("copy.ply"));
  EXPECT_EQ(labels_by(path("copy.ply"), path("dataset/A2/1")), labels);
  EXPECT_EQ(labels_by(path("copy.ply"), path("dataset/A2/1/")), labels);
  EXPECT_EQ(labels_by(path("copy.ply"), path("dataset/recipe.toml")), labels);
  const auto complaint = [&](const std::string& scene) {
    return model_without_scene("copy.ply", "--scene " + scene).err;
  };
  EXPECT_THAT(complaint(path("dataset")), HasSubstr("found a dataset, and '"));
  EXPECT_THAT(complaint(path("dataset/A2/7")), HasSubstr("found 'A2/7', expected a case of the dataset"));
}

}  // namespace
}  // namespace tanglebin
