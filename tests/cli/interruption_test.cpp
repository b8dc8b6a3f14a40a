// What happens to a run when somebody presses Ctrl-C, or when what it prints has no place to go.

#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/program.hpp"
#include "tests/support/recipe_text.hpp"

namespace tanglebin {
namespace {

namespace fs = std::filesystem;
using test::bytes_of;
using test::ProgramResult;
using test::run_program;
using test::run_shell;
using test::TemporaryDirectory;
using test::write_bytes;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

/// The program at work, whose standard output is read line by line.
class RunningProgram {
public:
  explicit RunningProgram(std::vector<std::string> arguments) {
    std::array<int, 2> ends{};
    if (pipe(ends.data()) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
    std::fflush(nullptr);  // or what is buffered comes out of both
    process_ = fork();
    if (process_ == 0) {
      dup2(ends[1], STDOUT_FILENO);
      close(ends[0]);
      close(ends[1]);
      arguments.insert(arguments.begin(), "tanglebin");
      std::vector<char*> texts;
      for (std::string& argument : arguments) texts.push_back(argument.data());
      texts.push_back(nullptr);
      execv(TANGLEBIN_PROGRAM, texts.data());
      _exit(127);
    }
    close(ends[1]);
    out_ = fdopen(ends[0], "r");
  }
  ~RunningProgram() { std::fclose(out_); }
  RunningProgram(const RunningProgram&) = delete;
  RunningProgram& operator=(const RunningProgram&) = delete;

  /// The next line; empty at the end.
  std::string line() {
    std::string text;
    for (int c = std::fgetc(out_); c != EOF && c != '\n'; c = std::fgetc(out_)) text += static_cast<char>(c);
    return text;
  }

  void interrupt(int signal = SIGINT) const { kill(process_, signal); }

  void interrupt_after_a_case(int signal = SIGINT) { interrupt_after("case", signal); }

  void interrupt_after(const std::string& event, int signal = SIGINT) {
    std::string text = line();
    while (!text.empty() && text.find("\"event\":\"" + event + "\"") == std::string::npos) text = line();
    interrupt(signal);
  }

  std::string last_line() {
    std::string last;
    for (std::string text = line(); !text.empty(); text = line()) last = text;
    return last;
  }

  int exit_status() const {
    int status = 0;
    waitpid(process_, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

private:
  pid_t process_ = 0;
  std::FILE* out_ = nullptr;
};

class Interruption : public testing::Test {
protected:
  static inline const std::string recipe =
      test::recipe_text({.seed = 5, .width = 48, .tubes = "[1]", .cases = 300});

  Interruption() { write_bytes(directory_ / "recipe.toml", recipe); }

  std::string path(const std::string& name) const { return (directory_ / name).string(); }
  std::string generate(const std::string& more) const {
    return "generate " + path("recipe.toml") + " --out " + path("dataset") + " " + more;
  }
  // No heap is at rest so soon, and nobody waits for so many attempts.
  std::string generate_without_end() const {
    write_bytes(directory_ / "recipe.toml",
                "attempts = 1000000000\n" + recipe + "[settle]\ntime_limit = 0.05\n");
    return generate("");
  }
  std::vector<std::string> names_in_dataset() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(path("dataset")))
      names.push_back(entry.path().filename());
    return names;
  }

  TemporaryDirectory directory_;
};

TEST_F(Interruption, OfGenerateFinishesTheCasesUnderWayAndLeavesADatasetAndNothingElse) {
  RunningProgram program({"generate", path("recipe.toml"), "--out", path("dataset"), "--progress", "json"});
  program.interrupt_after_a_case();
  const auto end = nlohmann::json::parse(program.last_line());
  EXPECT_EQ(program.exit_status(), 130);
  EXPECT_EQ(end.at("complete"), false);
  EXPECT_GT(end.at("made"), 0);
  EXPECT_EQ(end.at("dataset").at("cases"), end.at("made"));
  EXPECT_THAT(names_in_dataset(), UnorderedElementsAre("A1", "recipe.toml", "manifest.jsonl", "times.jsonl",
                                                       "dataset.json", ".lock"));
  const auto rest = nlohmann::json::parse(run_program(generate("--json")).out);
  EXPECT_EQ(rest.at("found"), end.at("made"));
  EXPECT_EQ(rest.at("complete"), true);
}

TEST_F(Interruption, BySigtermHasAnExitStatusOfItsOwn) {
  RunningProgram program({"generate", path("recipe.toml"), "--out", path("dataset"), "--progress", "json"});
  program.interrupt_after_a_case(SIGTERM);
  EXPECT_EQ(nlohmann::json::parse(program.last_line()).at("complete"), false);
  EXPECT_EQ(program.exit_status(), 143);
}

TEST_F(Interruption, OfACaseWithoutAValidSceneEndsItAfterTheAttempt) {
  generate_without_end();
  RunningProgram program({"generate", path("recipe.toml"), "--out", path("dataset"), "--progress", "json"});
  program.line();  // of progress: it has begun
  program.interrupt();
  const auto end = nlohmann::json::parse(program.last_line());
  EXPECT_EQ(program.exit_status(), 130);
  EXPECT_EQ(end.at("made"), 0);
  EXPECT_EQ(end.at("failed"), 0);
}

TEST_F(Interruption, IsAnsweredAtOnce) {
  const ProgramResult result = run_shell("timeout --foreground --signal=INT 1 " +
                                         std::string(TANGLEBIN_PROGRAM) + " " + generate_without_end());
  EXPECT_EQ(result.err, "tanglebin: stopping after the cases in progress; once more to end at once\n");
}

TEST_F(Interruption, OfARepairEndsItWithoutAnotherVerification) {
  run_program(generate(""));
  fs::remove_all(path("dataset/A1"));
  fs::remove(path("dataset/manifest.jsonl"));
  RunningProgram program({"verify", path("dataset"), "--repair", "--progress", "json"});
  program.interrupt_after_a_case();  // of the repair: there is none to verify
  const auto end = nlohmann::json::parse(program.last_line());
  EXPECT_EQ(program.exit_status(), 130);
  EXPECT_EQ(end.at("stopped"), true);
  EXPECT_GT(end.at("repaired"), 0);
  EXPECT_LT(end.at("repaired"), 300);
}

TEST_F(Interruption, OfACalibrationLeavesWhatIsScoredAndTheSameCommandGoesOn) {
  write_bytes(path("seen.toml"), test::recipe_text({.seed = 3, .width = 480, .tubes = "[1, 3]", .cases = 2}));
  write_bytes(path("start.toml"), "format = 1\naxis.fragment.points_min = 2000\n");  // finds no tube
  const auto arguments = [&](const std::string& profile) {
    return std::vector<std::string>{"calibrate",        path("seen.toml"), "--out", path(profile), "--start",
                                    path("start.toml"), "--scenes",        "2",     "--budget",    "200"};
  };
  const auto command = [&](const std::string& profile) {
    return fmt::format("{}", fmt::join(arguments(profile), " "));
  };
  ASSERT_EQ(run_program(command("whole.toml")).status, 0);
  EXPECT_THAT(bytes_of(path("whole.toml")), HasSubstr("axis.fragment.points_min = "));

  std::vector<std::string> with_events = arguments("mine.toml");
  with_events.insert(with_events.end(), {"--progress", "json"});
  RunningProgram program(with_events);
  program.interrupt_after("evaluations");
  program.last_line();
  EXPECT_EQ(program.exit_status(), 130);
  EXPECT_FALSE(fs::exists(path("mine.toml")));
  const std::string scored = bytes_of(path("mine.calibration/journal.jsonl"));

  const ProgramResult rest = run_program(command("mine.toml") + " --progress json");
  EXPECT_EQ(rest.status, 0) << rest.err;
  EXPECT_THAT(rest.out, HasSubstr("\"event\":\"end\""));
  EXPECT_EQ(bytes_of(path("mine.toml")), bytes_of(path("whole.toml")));
  const std::string all = bytes_of(path("mine.calibration/journal.jsonl"));
  EXPECT_EQ(all.substr(0, scored.size()), scored);
  EXPECT_GT(all.size(), scored.size());
}

TEST_F(Interruption, OfTheProgramThatReadsTheEventsLeavesTheRunAlone) {
  const ProgramResult result =
      run_shell("( " + std::string(TANGLEBIN_PROGRAM) + " " + generate("--cases 1-30 --progress json") +
                "; echo $? >" + path("status") + " ) | head -n 1");
  EXPECT_THAT(result.out, HasSubstr("\"event\":"));
  EXPECT_THAT(result.err, IsEmpty());
  EXPECT_EQ(bytes_of(path("status")), "0\n");
  EXPECT_EQ(nlohmann::json::parse(bytes_of(path("dataset/dataset.json"))).at("cases"), 30);
}

TEST_F(Interruption, OfTheTerminalLeavesTheRunAlone) {
  int terminal = -1;
  int end = -1;
  if (openpty(&terminal, &end, nullptr, nullptr, nullptr) != 0)
    GTEST_SKIP() << "no pseudo-terminal: " << std::strerror(errno);
  std::fflush(nullptr);
  const pid_t process = fork();
  if (process == 0) {
    dup2(end, STDERR_FILENO);
    close(end);
    close(terminal);
    freopen("/dev/null", "w", stdout);
    const std::string file = path("recipe.toml");
    const std::string out = path("dataset");
    execl(TANGLEBIN_PROGRAM, "tanglebin", "generate", file.c_str(), "--out", out.c_str(), nullptr);
    _exit(127);
  }
  close(end);
  std::array<char, 64> progress{};
  EXPECT_GT(read(terminal, progress.data(), progress.size()), 0);
  close(terminal);  // from here on writing gives EIO
  int status = 0;
  waitpid(process, &status, 0);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
  EXPECT_EQ(nlohmann::json::parse(bytes_of(path("dataset/dataset.json"))).at("cases"), 300);
}

TEST_F(Interruption, OutputThatIsLostIsAnError) {
  for (const std::string& command :
       {generate("--cases 1"), "verify " + path("dataset"), std::string("--help")}) {
    const ProgramResult result = run_program(command + " >/dev/full");
    EXPECT_EQ(result.status, 5) << command;
    EXPECT_EQ(result.err, "tanglebin: standard output: cannot write all output\n");
  }
  EXPECT_EQ(run_program(generate("--cases 2") + " 2>/dev/full").status, 0);
}

TEST_F(Interruption, OfNoneLeavesAWorkerAsLargeAfterManyCasesAsAfterTheFirst) {
#ifdef TANGLEBIN_SANITIZE
  GTEST_SKIP() << "the sanitizer keeps what is freed";
#endif
  ASSERT_EQ(run_program(generate("--jobs 1")).status, 0);
  std::istringstream lines(bytes_of(path("dataset/times.jsonl")));
  std::vector<double> peaks;
  for (std::string line; std::getline(lines, line);) {
    peaks.push_back(nlohmann::json::parse(line).at("peak_memory").get<double>());
  }
  ASSERT_EQ(peaks.size(), 300U);
  EXPECT_LT(peaks.back(), peaks.front() + 2);  // MiB
}

}  // namespace
}  // namespace tanglebin
