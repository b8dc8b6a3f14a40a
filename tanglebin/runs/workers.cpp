#include "tanglebin/runs/workers.hpp"

#include <fmt/core.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <deque>
#include <exception>
#include <memory>
#include <new>
#include <optional>
#include <set>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "tanglebin/base/error.hpp"
#include "tanglebin/runs/interrupt_guard.hpp"

namespace tanglebin {
namespace {

using Clock = std::chrono::steady_clock;

volatile std::sig_atomic_t interrupted = 0;
int first_interrupt = 0;  // of the last run

int guards = 0;
struct sigaction old_int {};
struct sigaction old_term {};

/// One end of the socket between the calling process and a worker. Both functions return false if the other
/// end is closed.
class Line {
public:
  explicit Line(int descriptor) : descriptor_(descriptor) {}
  ~Line() { close(descriptor_); }
  Line(const Line&) = delete;
  Line& operator=(const Line&) = delete;

  int descriptor() const { return descriptor_; }

  /// Lets the other end know that nothing more comes.
  void end() const { shutdown(descriptor_, SHUT_WR); }

  /// Whether the other end has called end(), if nothing is left to receive.
  bool has_ended() const {
    char byte = 0;
    return recv(descriptor_, &byte, 1, MSG_PEEK | MSG_DONTWAIT) == 0;
  }

  bool send_bytes(const void* bytes, std::size_t size) const {
    const auto* from = static_cast<const char*>(bytes);
    while (size > 0) {
      const ssize_t sent = send(descriptor_, from, size, MSG_NOSIGNAL);
      if (sent < 0 && errno != EINTR) return false;
      if (sent < 0) continue;
      from += sent;
      size -= static_cast<std::size_t>(sent);
    }
    return true;
  }

  bool receive_bytes(void* bytes, std::size_t size) const {
    auto* to = static_cast<char*>(bytes);
    while (size > 0) {
      const ssize_t received = recv(descriptor_, to, size, 0);
      if (received == 0 || (received < 0 && errno != EINTR)) return false;
      if (received < 0) continue;
      to += received;
      size -= static_cast<std::size_t>(received);
    }
    return true;
  }

private:
  int descriptor_;
};

enum class Outcome : std::uint32_t { done, bad_input, refused, impossible, stopped, exception };

/// A worker's answer.
struct Answer {
  Outcome outcome;
  std::string text;
};

bool send_answer(const Line& line, const Answer& answer) {
  const std::array<std::uint64_t, 2> head{static_cast<std::uint64_t>(answer.outcome), answer.text.size()};
  return line.send_bytes(head.data(), sizeof(head)) &&
         line.send_bytes(answer.text.data(), answer.text.size());
}

std::optional<Answer> receive_answer(const Line& line) {
  std::array<std::uint64_t, 2> head{};
  if (!line.receive_bytes(head.data(), sizeof(head))) return std::nullopt;
  Answer answer{static_cast<Outcome>(head[0]), std::string(head[1], '\0')};
  if (!line.receive_bytes(answer.text.data(), answer.text.size())) return std::nullopt;
  return answer;
}

Answer answer_of(const Task& task, std::size_t number) {
  try {
    return {Outcome::done, task(number)};
  } catch (const InputError& error) {
    return {Outcome::bad_input, error.what()};
  } catch (const SystemError& error) {
    return {Outcome::refused, error.what()};
  } catch (const TaskImpossible& error) {
    return {Outcome::impossible, error.what()};
  } catch (const TaskStopped&) {
    return {Outcome::stopped, {}};
  } catch (const std::bad_alloc&) {
    return {Outcome::exception, "out of memory"};
  } catch (const std::exception& error) {
    return {Outcome::exception, error.what()};
  }
}

// In a worker: its line to the parent.
const Line* line_of_worker = nullptr;

// Runs in a worker. The parent handles signals.
void work(const Line& line, const Task& task, pid_t parent) {
  std::signal(SIGINT, SIG_IGN);
  std::signal(SIGTERM, SIG_IGN);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) return;  // it was gone before prctl()
  line_of_worker = &line;
  std::uint64_t number = 0;
  while (line.receive_bytes(&number, sizeof(number))) {
    if (!send_answer(line, answer_of(task, number))) return;
  }
}

struct Worker {
  pid_t process = 0;
  std::unique_ptr<Line> line;
  std::optional<std::size_t> task;  ///< under way
  Clock::time_point since;
};

std::string end_of(int status) {
  if (WIFSIGNALED(status)) return fmt::format("its worker was ended by signal {}", WTERMSIG(status));
  return fmt::format("its worker ended with status {}", WEXITSTATUS(status));
}

/// The workers and their tasks.
class Crew {
public:
  Crew(std::size_t count, const Task& task, const WorkersObserver& observer, TimeLimit limit)
      : count_(count), task_(task), observer_(observer), limit_(limit) {}
  // Lets the workers finish their tasks, unless there is a signal.
  ~Crew() {
    for (Worker& worker : workers_) bury(worker);
  }
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;

  void hire() {
    const pid_t parent = getpid();
    std::array<int, 2> ends{};
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) throw_last_error("socketpair");
    Worker worker;
    worker.line = std::make_unique<Line>(ends[0]);
    auto other_end = std::make_unique<Line>(ends[1]);
    worker.process = fork();
    if (worker.process < 0) throw_last_error("fork");
    if (worker.process > 0) {
      workers_.push_back(std::move(worker));
      return;
    }
    // Otherwise another worker's socket would stay open here after the parent has closed it.
    worker.line.reset();
    for (Worker& other : workers_) other.line.reset();
    work(*other_end, task_, parent);
    _exit(0);  // not exit(): what the parent has registered and buffered is the parent's to finish
  }

  void hand_out_tasks() {
    for (Worker& worker : workers_) {
      if (!worker.task) hand_out(worker);
    }
  }

  bool is_under_way() const {
    return std::ranges::any_of(workers_, [](const Worker& worker) { return worker.task.has_value(); });
  }

  /// Throws the first error of a task that ended the run.
  void rethrow() const {
    if (!end_) return;
    if (end_->outcome == Outcome::refused) throw SystemError(end_->text);
    throw InputError({}, end_->text);
  }

  /// Waits briefly for answers, hands out the next tasks, and then reports what is done.
  void turn() {
    std::vector<pollfd> lines;
    lines.reserve(workers_.size());
    for (const Worker& worker : workers_) lines.push_back({worker.line->descriptor(), POLLIN, 0});
    constexpr int milliseconds = 100;
    if (poll(lines.data(), lines.size(), milliseconds) < 0 && errno != EINTR) throw_last_error("poll");
    if (interrupted != 0) take_interrupt();

    std::vector<TaskResult> results;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      if (lines[i].revents != 0) listen_to(workers_[i], results);
    }
    end_slow_tasks();
    const std::size_t dead = std::erase_if(workers_, [](const Worker& worker) { return !worker.line; });
    hand_out_tasks();
    if (!results.empty()) observer_.done(results);
    for (const TaskFailure& failure : std::exchange(failures_, {})) observer_.failed(failure);
    replace(dead);  // only now: it may throw
    observer_.tick();
  }

private:
  [[noreturn]] static void throw_last_error(const char* what) {
    throw std::system_error(errno, std::generic_category(), what);
  }

  // What runs commands, such as timeout(1), may send a signal twice at once, which is one wish.
  void take_interrupt() {
    constexpr std::chrono::milliseconds one_wish{500};
    const int signal = interrupted;
    interrupted = 0;
    if (!interrupted_at_) {
      first_interrupt = signal;
      interrupted_at_ = Clock::now();
      stop();
      observer_.stopping();
    } else if (Clock::now() - *interrupted_at_ > one_wish) {
      for (const Worker& worker : workers_) kill(worker.process, SIGKILL);
      for (Worker& worker : workers_) worker.task.reset();
    }
  }

  // Hands out no more tasks, and lets those under way know.
  void stop() {
    stopped_ = true;
    for (const Worker& worker : workers_) {
      if (worker.line) worker.line->end();
    }
  }

  void end_slow_tasks() {
    for (Worker& worker : workers_) {
      if (!worker.task || Clock::now() - worker.since <= limit_) continue;
      kill(worker.process, SIGKILL);
      bury(worker);
      failures_.push_back({*worker.task, fmt::format("took longer than {:g} s",
                                                     std::chrono::duration<double>(limit_).count())});
      worker.task.reset();
    }
  }

  std::optional<std::size_t> next_task() {
    if (stopped_) return std::nullopt;
    if (!again_.empty()) {
      const std::size_t task = again_.front();
      again_.pop_front();
      return task;
    }
    if (next_ == count_) return std::nullopt;
    return next_++;
  }

  void hand_out(Worker& worker) {
    worker.task = next_task();
    if (!worker.task) return;
    worker.since = Clock::now();
    const std::uint64_t number = *worker.task;
    worker.line->send_bytes(&number, sizeof(number));  // that it is dead will show when it does not answer
  }

  void listen_to(Worker& worker, std::vector<TaskResult>& results) {
    std::optional<Answer> answer = receive_answer(*worker.line);
    if (!answer) {
      const std::string reason = end_of(bury(worker));
      if (worker.task) retry_or_give_up(*worker.task, reason);
      worker.task.reset();
      return;
    }
    if (!worker.task) return;  // answered just before it was killed
    const std::size_t task = *worker.task;
    worker.task.reset();
    switch (answer->outcome) {
      case Outcome::done: {
        const double seconds = std::chrono::duration<double>(Clock::now() - worker.since).count();
        results.push_back({task, std::move(answer->text), seconds});
        break;
      }
      case Outcome::bad_input:
      case Outcome::refused:
        if (!end_) end_ = std::move(answer);
        stop();
        break;
      case Outcome::impossible:
        failures_.push_back({task, std::move(answer->text)});
        break;
      case Outcome::stopped:
        again_.push_front(task);
        break;
      case Outcome::exception:
        retry_or_give_up(task, answer->text);
        break;
    }
  }

  void retry_or_give_up(std::size_t task, const std::string& reason) {
    if (tried_.insert(task).second) {
      again_.push_back(task);
    } else {
      failures_.push_back({task, reason + ", the second time"});
    }
  }

  void replace(std::size_t dead) {
    for (std::size_t i = 0; i < dead && !stopped_; ++i) hire();
    hand_out_tasks();
  }

  // Closes the worker's socket and waits for its end; returns the status.
  static int bury(Worker& worker) {
    worker.line.reset();
    int status = 0;
    while (waitpid(worker.process, &status, 0) < 0 && errno == EINTR) {
      if (interrupted != 0) kill(worker.process, SIGKILL);
    }
    return status;
  }

  std::size_t count_;
  const Task& task_;
  const WorkersObserver& observer_;
  TimeLimit limit_;
  std::vector<Worker> workers_;
  std::size_t next_ = 0;           ///< task to hand out next
  std::deque<std::size_t> again_;  ///< before that, those to try again
  std::set<std::size_t> tried_;    ///< those that failed once
  std::vector<TaskFailure> failures_;
  std::optional<Answer> end_;  ///< an error that ends the run
  bool stopped_ = false;       ///< hand out no more
  std::optional<Clock::time_point> interrupted_at_;
};

}  // namespace

void stop_if_asked() {
  if (line_of_worker != nullptr && line_of_worker->has_ended()) throw TaskStopped();
}

void validate_jobs(int jobs) {
  constexpr int most = 1024;
  if (jobs < 1 || jobs > most)
    throw InputError({"", 0, "jobs"}, fmt::format("{}", jobs), fmt::format("1 to {}", most));
}

bool run_in_workers(int jobs, std::size_t count, const Task& task, const WorkersObserver& observer,
                    TimeLimit limit) {
  const InterruptGuard guard;
  first_interrupt = 0;
  Crew crew(count, task, observer, limit);
  for (int i = 0; i < jobs && static_cast<std::size_t>(i) < count; ++i) crew.hire();
  crew.hand_out_tasks();
  while (crew.is_under_way()) crew.turn();
  crew.rethrow();
  if (first_interrupt == 0) first_interrupt = interrupted;
  return first_interrupt == 0;
}

InterruptGuard::InterruptGuard() {
  if (guards++ > 0) return;
  interrupted = 0;
  struct sigaction remember {};
  remember.sa_handler = [](int signal) { interrupted = signal; };
  sigaction(SIGINT, &remember, &old_int);
  sigaction(SIGTERM, &remember, &old_term);
}

InterruptGuard::~InterruptGuard() {
  if (--guards > 0) return;
  sigaction(SIGINT, &old_int, nullptr);
  sigaction(SIGTERM, &old_term, nullptr);
}

int interrupting_signal() {
  return first_interrupt;
}

}  // namespace tanglebin
