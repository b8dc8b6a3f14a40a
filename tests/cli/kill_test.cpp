// Whatever is killed, and whenever, the same command goes on to the same dataset. Thirty kills; for more
//   TANGLEBIN_KILLS=500 build/test_cli --gtest_filter='Kill.*'

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "tanglebin/cli/terminal/exit_status.hpp"
#include "tests/support/processes.hpp"
#include "tests/support/program.hpp"

namespace tanglebin {
namespace {

namespace fs = std::filesystem;
using test::bytes_of;
using test::run_program;
using test::TemporaryDirectory;
using test::write_bytes;
using Clock = std::chrono::steady_clock;

int kills_wanted() {
  const char* text = std::getenv("TANGLEBIN_KILLS");
  return text == nullptr ? 30 : std::stoi(text);
}

class Kill : public testing::Test {
protected:
  static constexpr const char* recipe = R"(
seed = 5
[scanner]
width = 96
height = 60
[output]
depths = true
[[set]]
name = "A"
tubes = [1, 2]
cases = 30
[set.tube]
radius = 0.0125
mass = 0.5
length = 0.5
bend_max_deg = 30
)";

  Kill() {
    write_bytes(directory_ / "recipe.toml", recipe);
    const Clock::time_point start = Clock::now();
    EXPECT_EQ(
        run_program("generate " + path("recipe.toml") + " --jobs 2 --out " + path("undisturbed")).status, 0);
    undisturbed_seconds_ = std::chrono::duration<double>(Clock::now() - start).count();
  }

  std::string path(const std::string& name) const { return (directory_ / name).string(); }

  pid_t start_run(std::vector<std::string> arguments) const {
    std::vector<char*> words;
    for (std::string& argument : arguments) words.push_back(argument.data());
    words.push_back(nullptr);
    std::fflush(stdout);  // or what is buffered comes out of both
    const pid_t process = fork();
    if (process == 0) {
      freopen("/dev/null", "w", stdout);
      freopen(path("errors").c_str(), "a", stderr);
      execv(TANGLEBIN_PROGRAM, words.data());
      _exit(127);
    }
    return process;
  }

  // The same command again and again, until it has come to its end. Returns the number of its runs.
  int run_disturbed(const std::vector<std::string>& arguments) {
    int runs = 0;
    for (int status = -1; status != 0; ++runs) {
      status = disturb(start_run(arguments));
      // A case whose worker was killed twice was given up; the next run makes it.
      const bool goes_on =
          WIFSIGNALED(status) || WEXITSTATUS(status) == 0 || WEXITSTATUS(status) == cli::exit_cases_failed;
      if (!goes_on) {
        ADD_FAILURE() << "status " << status << ": " << bytes_of(path("errors"));
        break;
      }
    }
    return runs;
  }

  // Kills the run or one of its workers at random moments until the run has ended; returns its status.
  int disturb(pid_t run) {
    int status = 0;
    while (true) {
      std::this_thread::sleep_for(std::chrono::duration<double>(
          std::uniform_real_distribution<double>(0, undisturbed_seconds_ / 2)(random_)));
      if (waitpid(run, &status, WNOHANG) == run) return status;
      std::vector<pid_t> victims = test::children_of(run);
      victims.resize(2 * victims.size() + 1, run);  // the run itself about as often as a worker
      kill(victims[std::uniform_int_distribution<std::size_t>(0, victims.size() - 1)(random_)], SIGKILL);
      ++kills_;
    }
  }

  // All that is there but how long it took: no file and no directory is left over.
  static std::map<std::string, std::string> everything_in(const fs::path& directory) {
    std::map<std::string, std::string> entries;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(directory)) {
      const std::string name = fs::relative(entry.path(), directory).string();
      entries[name] = entry.is_regular_file() && name != "times.jsonl" ? bytes_of(entry.path()) : "";
    }
    return entries;
  }

  TemporaryDirectory directory_;
  double undisturbed_seconds_ = 0;
  std::mt19937 random_{20};
  int kills_ = 0;
};

TEST_F(Kill, AtAnyMomentLosesNoFinishedCaseAndLeavesNothingOver) {
  const auto expected = everything_in(path("undisturbed"));
  int datasets = 0;
  int runs = 0;
  for (; kills_ < kills_wanted(); ++datasets) {
    runs += run_disturbed(
        {"tanglebin", "generate", path("recipe.toml"), "--jobs", "2", "--out", path("disturbed")});
    ASSERT_FALSE(HasFailure());
    ASSERT_EQ(everything_in(path("disturbed")), expected) << "after " << kills_ << " kills";
    ASSERT_EQ(run_program("verify " + path("disturbed")).status, 0);
    fs::remove_all(path("disturbed"));
  }
  std::cout << kills_ << " kills in " << runs << " runs of " << datasets << " datasets\n";
  EXPECT_GT(runs, datasets);  // some kills did end a run
}

TEST_F(Kill, OfAnExportLosesNothingOfItEither) {
  const std::string dataset = path("undisturbed");
  const Clock::time_point start = Clock::now();
  ASSERT_EQ(run_program("export " + dataset + " --format hdf5 --jobs 2 --out " + path("export")).status, 0);
  undisturbed_seconds_ = std::chrono::duration<double>(Clock::now() - start).count();
  const auto expected = everything_in(path("export"));
  int runs = 0;
  for (int exports = 0; kills_ < 10 || runs == exports; ++exports) {
    runs += run_disturbed(
        {"tanglebin", "export", dataset, "--format", "hdf5", "--jobs", "2", "--out", path("disturbed")});
    ASSERT_FALSE(HasFailure());
    ASSERT_EQ(everything_in(path("disturbed")), expected) << "after " << kills_ << " kills";
    fs::remove_all(path("disturbed"));
  }
}

}  // namespace
}  // namespace tanglebin
