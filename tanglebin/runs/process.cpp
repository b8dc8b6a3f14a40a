#include "tanglebin/runs/process.hpp"

#include <fcntl.h>
#include <linux/close_range.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <climits>
#include <csignal>
#include <fstream>
#include <system_error>
#include <utility>

// A supervisor stands between the calling process and the program: a fork of the former that adopts whatever
// the program leaves behind (PR_SET_CHILD_SUBREAPER), and kills it when the program has ended, when the
// calling process asks for it, and when that is gone.
namespace tanglebin {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

[[noreturn]] void fail(int error, const std::string& what) {
  throw std::system_error(error, std::generic_category(), what);
}

/// An open file that is closed with this, and in a program that is started.
class Descriptor {
public:
  explicit Descriptor(int number = -1) : number_(number) {}
  ~Descriptor() { reset(); }
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }

  int number() const { return number_; }
  bool is_open() const { return number_ >= 0; }
  void reset() {
    if (is_open()) close(std::exchange(number_, -1));
  }

private:
  int number_;
};

struct Pipe {
  Descriptor from;
  Descriptor to;
};

Pipe make_pipe() {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) fail(errno, "cannot create a pipe");
  return {Descriptor(ends[0]), Descriptor(ends[1])};
}

/// A file in memory with these bytes, to be read from its beginning. Unlike a pipe, it takes any number of
/// bytes at once, so neither side waits for the other.
Descriptor file_with(const std::string& bytes) {
  Descriptor file(memfd_create("input", MFD_CLOEXEC));
  if (!file.is_open()) fail(errno, "cannot create a file in memory");
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t written = write(file.number(), bytes.data() + done, bytes.size() - done);
    if (written < 0 && errno != EINTR) fail(errno, "cannot write a file in memory");
    if (written > 0) done += static_cast<std::size_t>(written);
  }
  lseek(file.number(), 0, SEEK_SET);
  return file;
}

/// What the supervisor reports: first an error if the program could not be started, at the end its status.
struct Report {
  int error;
  int status;  ///< of waitpid()
};

void send(const Descriptor& to, const Report& report) {
  while (write(to.number(), &report, sizeof(report)) < 0 && errno == EINTR) {
  }
}

// ---- in the program's process, before it is there

void limit(__rlimit_resource resource, const std::optional<std::uint64_t>& value) {
  if (!value) return;
  const rlimit both{*value, *value};
  setrlimit(resource, &both);
}

std::vector<char*> pointers_to(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  pointers.reserve(texts.size() + 1);
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

[[noreturn]] void become(Process process, const Descriptor& in, const Pipe& out, const Pipe& err,
                         const Pipe& reports) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  for (const int signal : {SIGINT, SIGTERM, SIGPIPE, SIGXFSZ, SIGCHLD}) std::signal(signal, SIG_DFL);
  dup2(in.number(), STDIN_FILENO);
  dup2(out.to.number(), STDOUT_FILENO);
  dup2(err.to.number(), STDERR_FILENO);
  close_range(STDERR_FILENO + 1, UINT_MAX, CLOSE_RANGE_CLOEXEC);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_AS, process.limits.memory);
  limit(RLIMIT_FSIZE, process.limits.disk);
  if (chdir(process.directory.c_str()) == 0) {
    const std::vector<char*> arguments = pointers_to(process.command);
    const std::vector<char*> environment = pointers_to(process.environment);
    execvpe(arguments.front(), arguments.data(), environment.data());
  }
  send(reports.to, {errno, 0});
  _exit(127);
}

// ---- in the supervisor

std::vector<pid_t> children() {
  const std::string self = std::to_string(getpid());
  std::ifstream list("/proc/" + self + "/task/" + self + "/children");
  std::vector<pid_t> children;
  for (pid_t child = 0; list >> child;) children.push_back(child);
  return children;
}

// Orphans become children of the supervisor, so that in the end it has had them all.
void kill_all_descendants(pid_t program, int& status) {
  while (true) {
    for (const pid_t child : children()) kill(child, SIGKILL);
    int its_status = 0;
    const pid_t ended = waitpid(-1, &its_status, 0);
    if (ended == program) status = its_status;
    if (ended < 0 && errno == ECHILD) return;
  }
}

// Waits until the program has ended, or SIGTERM comes.
void wait_for_end(pid_t program, const sigset_t& awaited, int& status) {
  while (true) {
    if (sigwaitinfo(&awaited, nullptr) == SIGTERM) return;
    int its_status = 0;
    for (pid_t ended = 1; ended > 0;) {
      ended = waitpid(-1, &its_status, WNOHANG);
      if (ended != program) continue;
      status = its_status;
      return;
    }
  }
}

[[noreturn]] void supervise(const Process& process, const Descriptor& in, Pipe out, Pipe err,
                            const Pipe& reports, pid_t parent) {
  sigset_t awaited;
  sigemptyset(&awaited);
  sigaddset(&awaited, SIGCHLD);
  sigaddset(&awaited, SIGTERM);
  sigprocmask(SIG_BLOCK, &awaited, nullptr);
  std::signal(SIGTERM, SIG_DFL);  // what is ignored is not awaited
  setpgid(0, 0);
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(0);  // it was gone before prctl()
  const pid_t program = fork();
  if (program == 0) become(process, in, out, err, reports);
  Report report{program < 0 ? errno : 0, SIGKILL};
  out.to.reset();
  err.to.reset();
  if (program > 0) {
    wait_for_end(program, awaited, report.status);
    kill_all_descendants(program, report.status);
  }
  send(reports.to, report);
  _exit(0);
}

// ---- in the calling process

/// The end of what a program writes.
class Tail {
public:
  Tail(Descriptor from, std::size_t most) : from_(std::move(from)), most_(most) {}

  int descriptor() const { return from_.number(); }
  std::string text() && { return std::move(text_); }

  /// Takes what is there; closes at the end.
  void read() {
    std::array<char, 1 << 16> block;
    const ssize_t count = ::read(from_.number(), block.data(), block.size());
    if (count < 0 && errno == EINTR) return;
    if (count <= 0) return from_.reset();
    text_.append(block.data(), static_cast<std::size_t>(count));
    if (text_.size() > most_) text_.erase(0, text_.size() - most_);
  }

private:
  Descriptor from_;
  std::size_t most_;
  std::string text_;
};

std::uintmax_t size_below(const fs::path& directory) {
  std::uintmax_t size = 0;
  std::error_code ignored;  // files come and go
  for (fs::recursive_directory_iterator entry(directory, ignored), end; entry != end;) {
    const bool is_file = entry->is_regular_file(ignored) && !entry->is_symlink(ignored);
    const std::uintmax_t its = is_file ? entry->file_size(ignored) : 0;
    if (its != static_cast<std::uintmax_t>(-1)) size += its;
    entry.increment(ignored);
    if (ignored) break;
  }
  return size;
}

/// A supervisor at work.
class Supervised {
public:
  Supervised(const Process& process, pid_t supervisor, Descriptor out, Descriptor err, Descriptor reports)
      : process_(process),
        supervisor_(supervisor),
        out_(std::move(out), process.output_max),
        err_(std::move(err), process.output_max),
        reports_(std::move(reports)) {}
  ~Supervised() {
    if (supervisor_ > 0) end();
  }
  Supervised(const Supervised&) = delete;
  Supervised& operator=(const Supervised&) = delete;

  ProcessResult wait() {
    while (reports_.is_open() || out_.descriptor() >= 0 || err_.descriptor() >= 0) {
      take_what_comes();
      end_if_beyond_limits();
    }
    wait_for_supervisor();
    if (report_.error != 0) fail(report_.error, "cannot start " + process_.command.front());
    return result();
  }

private:
  void take_what_comes() {
    std::array<pollfd, 3> files{
        {{out_.descriptor(), POLLIN, 0}, {err_.descriptor(), POLLIN, 0}, {reports_.number(), POLLIN, 0}}};
    constexpr int milliseconds = 100;
    if (poll(files.data(), files.size(), milliseconds) <= 0) return;
    if (files[0].revents != 0) out_.read();
    if (files[1].revents != 0) err_.read();
    if (files[2].revents != 0) read_report();
  }

  void read_report() {
    Report report{};
    const ssize_t count = ::read(reports_.number(), &report, sizeof(report));
    if (count < 0 && errno == EINTR) return;
    if (count != sizeof(report)) return reports_.reset();
    if (report_.error == 0) report_ = report;
  }

  void end_if_beyond_limits() {
    const Clock::time_point now = Clock::now();
    if (now < next_look_) return;
    constexpr std::chrono::milliseconds between_looks{100};
    next_look_ = now + between_looks;
    if (end_ == ProcessEnd::exited) end_ = end_by_limits(now);
    if (end_ != ProcessEnd::exited) kill(supervisor_, SIGTERM);  // again, if it was not ready for it
  }

  ProcessEnd end_by_limits(Clock::time_point now) const {
    const auto& [time, memory, disk] = process_.limits;
    if (now - start_ > time) return ProcessEnd::too_slow;
    if (disk && size_below(process_.directory) > *disk) return ProcessEnd::too_large;
    return ProcessEnd::exited;
  }

  void end() {
    kill(supervisor_, SIGTERM);
    wait_for_supervisor();
  }

  void wait_for_supervisor() {
    while (waitpid(supervisor_, nullptr, 0) < 0 && errno == EINTR) {
    }
    supervisor_ = 0;
  }

  ProcessResult result() {
    ProcessResult result{end_, 0, std::move(out_).text(), std::move(err_).text()};
    if (end_ != ProcessEnd::exited) return result;
    const bool is_killed = WIFSIGNALED(report_.status);
    result.status = is_killed ? WTERMSIG(report_.status) : WEXITSTATUS(report_.status);
    if (is_killed) result.end = result.status == SIGXFSZ ? ProcessEnd::too_large : ProcessEnd::killed;
    return result;
  }

  const Process& process_;
  pid_t supervisor_;
  Tail out_;
  Tail err_;
  Descriptor reports_;
  Report report_{0, SIGKILL};
  ProcessEnd end_ = ProcessEnd::exited;
  Clock::time_point start_ = Clock::now();
  Clock::time_point next_look_ = start_;
};

}  // namespace

ProcessResult run_process(const Process& process) {
  const Descriptor in = file_with(process.input);
  Pipe out = make_pipe();
  Pipe err = make_pipe();
  Pipe reports = make_pipe();
  const pid_t parent = getpid();
  const pid_t supervisor = fork();
  if (supervisor < 0) fail(errno, "cannot start " + process.command.front());
  if (supervisor == 0) supervise(process, in, std::move(out), std::move(err), reports, parent);
  out.to.reset();
  err.to.reset();
  reports.to.reset();
  return Supervised(process, supervisor, std::move(out.from), std::move(err.from), std::move(reports.from))
      .wait();
}

}  // namespace tanglebin
