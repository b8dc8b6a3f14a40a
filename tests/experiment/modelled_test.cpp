#include "tanglebin/experiment/modelled.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <sstream>
#include <string>

#include "tanglebin/cloud/label_colors.hpp"
#include "tanglebin/experiment/given_cloud.hpp"
#include "tanglebin/experiment/measures.hpp"
#include "tanglebin/io/configuration.hpp"
#include "tanglebin/io/ply.hpp"
#include "tests/experiment/small_dataset.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/processes.hpp"

namespace tanglebin {
namespace {

namespace fs = std::filesystem;
using test::bytes_of;
using test::complaint;
using test::SmallDataset;
using test::TemporaryDirectory;
using test::write_bytes;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

/// A case, and algorithms from outside that model it.
class OutsideAlgorithm : public testing::Test {
protected:
  Modelled model_by_shell(const std::string& script, const std::string& arguments = "{cloud} {out.txt}",
                          ProcessLimits limits = default_limits()) const {
    write_bytes(work_ / "method.sh", script);
    const Command command = command_of("sh method.sh " + arguments, work_.path(), limits);
    return model_by({"mine", command}, known_, data_, run_, settings_, scratch_.path());
  }

  Modelled model_by_labels(const std::string& directory) const {
    return model_by({"mine", LabelsDirectory{directory}}, known_, data_, run_, settings_, {});
  }

  Modelled model_by_axes() const {
    RunId run = run_;
    run.method = "axis";
    return model_by(entry_of(Method::axis), known_, data_, run, settings_, {});
  }

  std::string failure_of(const std::string& script, const std::string& arguments = "{cloud} {out.txt}",
                         ProcessLimits limits = default_limits()) const {
    const std::string failure = complaint([&] { model_by_shell(script, arguments, limits); });
    EXPECT_TRUE(fs::is_empty(scratch_.path())) << "the command's directory is gone";
    EXPECT_EQ(failure.find(scratch_.path().string()), std::string::npos) << failure;
    return failure;
  }

  std::string dump(const Modelled& modelled) const {
    const ModelScore score = score_model(data_, modelled.model, modelled.has_tubes);
    std::string text = measures_json(score.labels).dump();
    if (score.tubes) text += measures_json(*score.tubes).dump();
    return text;
  }

  SmallDataset directory_;
  Dataset dataset_ = directory_.read();
  RunId run_{"mine", {"A", 3, 1}, 0.5};
  ExperimentSettings settings_{.ratios = {0.5}, .model = {.seed = 5}};
  CaseData data_ = read_case(dataset_, run_.scene);
  KnownScene known_ = known_scene(recipe_of(dataset_, run_.scene), run_.scene);
  TemporaryDirectory scratch_;
  TemporaryDirectory work_;
};

TEST_F(OutsideAlgorithm, ThatCopiesOurLabelsAndTubesHasOurScoresToTheLastDigit) {
  const Modelled ours = model_by_axes();
  std::ostringstream cloud;
  write_ply(cloud, labelled(data_.cloud, ours.model.labels));
  std::ostringstream tubes;
  write_configuration(tubes, ours.model.tubes);
  fs::create_directories(work_ / "0.5/A3/plys");
  fs::create_directories(work_ / "0.5/A3/tube_configurations");
  write_bytes(work_ / "0.5/A3/plys/1.ply", cloud.str());
  write_bytes(work_ / "0.5/A3/tube_configurations/1.txt", tubes.str());
  EXPECT_EQ(dump(model_by_labels((work_ / "{ratio}").string())), dump(ours));

  // A program gets half of the points: it looks their labels up by what it was given.
  const SeenPoints seen = seen_points(data_.cloud, known_, run_.ratio, model_seed(settings_, run_.scene));
  std::string labels;
  for (const std::size_t point : seen.given) labels += std::to_string(ours.model.labels[point]) + '\n';
  write_bytes(work_ / "labels.txt", labels);
  EXPECT_EQ(dump(model_by_shell("cp " + (work_ / "labels.txt").string() + " \"$2\"; cp " +
                                    (work_ / "0.5/A3/tube_configurations/1.txt").string() + " \"$3\"",
                                "{cloud} {out.txt} {tubes}")),
            dump(ours));
}

TEST_F(OutsideAlgorithm, ThatGivesOnlyTubesLabelsThePointsNearThem) {
  std::ostringstream tubes;
  write_configuration(tubes, data_.tubes);
  write_bytes(work_ / "true.txt", tubes.str());
  const Modelled modelled =
      model_by_shell("cp " + (work_ / "true.txt").string() + " \"$2\"", "{cloud.pcd} {tubes}");
  EXPECT_TRUE(modelled.has_tubes);
  const ModelScore score = score_model(data_, modelled.model);
  EXPECT_GT(score.labels.micro_recall, 0.99);
  EXPECT_EQ(score.tubes->complete_tubes, 3);
}

TEST_F(OutsideAlgorithm, ThatGivesOnlyLabelsHasNoScoreOfTubes) {
  const Modelled modelled = model_by_shell(
      "n=$(sed -n 's/^element vertex //p' \"$1\" | head -n 1); yes 1 | head -n \"$n\" >\"$2\"");
  EXPECT_FALSE(modelled.has_tubes);
  EXPECT_TRUE(modelled.model.tubes.empty());
  EXPECT_GT(score_model(data_, modelled.model, false).labels.micro_recall, 0.3);
}

TEST_F(OutsideAlgorithm, SeesTheCloudAndTheSceneAndNothingElseOfTheCase) {
  const std::string seen = (work_ / "seen").string();
  failure_of("mkdir " + seen + "; cp -r . " + seen + "/files; env >" + seen + "/env; echo \"$@\" >" + seen +
                 "/arguments; cat >" + seen + "/stdin; ls -la /proc/$$/fd >" + seen + "/descriptors; exit 1",
             "{cloud} {scene} {tubes}");
  std::map<std::string, std::string> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(fs::path(seen) / "files"))
    files[entry.path().filename().string()] = bytes_of(entry.path());
  EXPECT_EQ(files.size(), 2U) << "cloud.ply and scene.toml";
  const PointCloud cloud = read_ply(fs::path(seen) / "files/cloud.ply");
  EXPECT_TRUE(cloud.labels.empty() && cloud.colors.empty() && cloud.normals.empty() && cloud.mixed.empty());

  // What would give the truth away: where the dataset is, which case this is, and where a tube lies.
  std::vector<std::string> secrets = {dataset_.directory.string(), "A3/", "label"};
  for (const Tube& tube : data_.tubes)
    secrets.push_back(std::to_string(tube.nodes.front().position.x()).substr(0, 6));
  for (const std::string& secret : secrets) {
    for (const char* input : {"env", "arguments", "stdin", "descriptors", "files/scene.toml"})
      EXPECT_EQ(bytes_of(fs::path(seen) / input).find(secret), std::string::npos)
          << secret << " in " << input;
  }
}

TEST_F(OutsideAlgorithm, ThatFailsIsNamedWithItsLastWords) {
  EXPECT_EQ(failure_of("echo trouble with \"$1\" >&2; exit 3"),
            "the command ended with status 3: trouble with cloud.ply");
  EXPECT_THAT(failure_of("kill -SEGV $$"), StartsWith("the command was ended by signal 11 ("));
  EXPECT_EQ(failure_of("echo said"), "the command wrote none of the files that it was asked for: said");
  EXPECT_EQ(failure_of("echo 1 >elsewhere.txt"), "the command wrote none of the files that it was asked for");
  EXPECT_THAT(failure_of("echo 1 >\"$2\""), HasSubstr("out.txt: found 1 labels, expected "));
  EXPECT_EQ(failure_of("echo one >\"$2\""),
            "out.txt:1: found 'one', expected a label: an integer from -1 to 2147483647");
  EXPECT_THAT(failure_of("head -c 99999 /dev/urandom >\"$2\"", "{cloud} {out.npy}"), HasSubstr("out.npy"));
  EXPECT_THAT(failure_of("mkfifo \"$2\""), HasSubstr("out.txt: found a pipe, expected a regular file"));
  EXPECT_THAT(failure_of("mkdir \"$2\"", "{cloud} {tubes}"), HasSubstr("tubes.txt"));
  EXPECT_THAT(failure_of("mkdir -p a/b; chmod 0 a; exit 1"), HasSubstr("status 1"));
}

TEST_F(OutsideAlgorithm, ThatFloodsStandardErrorKeepsItsLastLines) {
  const std::string failure = failure_of("yes $1 | head -c 3000000 >&2; echo the end >&2; exit 1");
  EXPECT_LT(failure.size(), 5000U);
  EXPECT_THAT(failure, AllOf(HasSubstr("status 1"), HasSubstr("the end")));
}

TEST_F(OutsideAlgorithm, ThatFloodsTheDiskIsStopped) {
  ProcessLimits limits = default_limits();
  limits.disk = 10 << 20;
  EXPECT_EQ(failure_of("exec head -c 100000000 /dev/zero >\"$2\"", "{cloud} {out.txt}", limits),
            "the command wrote more than 10485760 bytes");
}

TEST_F(OutsideAlgorithm, ThatHangsIsEndedWithAllThatItStarted) {
  ProcessLimits limits = default_limits();
  limits.time = std::chrono::milliseconds(500);
  const std::string pid = (work_ / "pid").string();
  EXPECT_EQ(failure_of("setsid sleep 1000 & echo $! >" + pid + "; sleep 1000", "{cloud} {out.txt}", limits),
            "the command took longer than 0.5 s");
  EXPECT_FALSE(test::is_running(std::stoi(bytes_of(pid))));
}

TEST_F(OutsideAlgorithm, ThatFloodsStandardErrorWithoutEndIsEnded) {
  ProcessLimits limits = default_limits();
  limits.time = std::chrono::milliseconds(500);
  const std::string failure = failure_of("yes trouble >&2", "{cloud} {out.txt}", limits);
  EXPECT_LT(failure.size(), 5000U);
  EXPECT_THAT(failure, StartsWith("the command took longer than 0.5 s"));
}

TEST_F(OutsideAlgorithm, ThatLeavesProcessesBehindIsScoredAndTheyAreEnded) {
  const std::string pids = (work_ / "pids").string();
  const Modelled modelled = model_by_shell(
      "(setsid sh -c 'echo $$ >>" + pids + "; sleep 1000' &); sleep 1000 & echo $! >>" + pids +
      "\nuntil [ $(wc -l <" + pids +
      ") = 2 ]; do :; done\n"
      "n=$(sed -n 's/^element vertex //p' \"$1\" | head -n 1); yes 1 | head -n \"$n\" >\"$2\"");
  EXPECT_GT(score_model(data_, modelled.model, false).labels.micro_recall, 0.3);
  std::istringstream left(bytes_of(pids));
  for (pid_t pid = 0; left >> pid;) EXPECT_FALSE(test::is_running(pid));
  EXPECT_TRUE(fs::is_empty(scratch_.path()));
}

TEST_F(OutsideAlgorithm, ThatCannotStartIsNamed) {
  const fs::path program = work_ / "method";
  write_bytes(program, "#!/no/such/interpreter\n");
  fs::permissions(program, fs::perms::owner_all);
  const Command command = command_of("./method {cloud} {out.txt}", work_.path());
  const auto run = [&] { model_by({"mine", command}, known_, data_, run_, settings_, scratch_.path()); };
  EXPECT_THAT(complaint(run), AllOf(HasSubstr("cannot start "), HasSubstr("No such file or directory")));
  fs::permissions(program, fs::perms::owner_read);
  EXPECT_THAT(complaint(run), AllOf(HasSubstr("cannot start "), HasSubstr("Permission denied")));
  fs::remove(program);
  EXPECT_THAT(complaint(run), HasSubstr("cannot start "));
  EXPECT_TRUE(fs::is_empty(scratch_.path()));
}

TEST_F(OutsideAlgorithm, LabelsThatAreMissingOrOfOtherPointsAreNamed) {
  EXPECT_THAT(complaint([&] { model_by_labels(work_.path().string()); }),
              HasSubstr(": found no labels, expected A3/plys/1.ply or another file of labels or tubes"));
  fs::create_directories(work_ / "A3/labels");
  write_bytes(work_ / "A3/labels/1.txt", "1\n2\n");
  EXPECT_THAT(complaint([&] { model_by_labels(work_.path().string()); }),
              HasSubstr("A3/labels/1.txt: found 2 labels, expected "));
}

}  // namespace
}  // namespace tanglebin
