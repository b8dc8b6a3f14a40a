#include "tanglebin/dataset/workers.hpp"

#include <fmt/core.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <exception>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>

#include "tanglebin/base/error.hpp"

namespace tanglebin {
namespace {

enum class Failure : int { none, bad_input, other };

/// What the processes share. The first task that fails leaves its message.
struct Board {
  std::atomic<std::size_t> next{0};  ///< task to take next
  std::atomic<std::size_t> done{0};  ///< tasks done
  std::atomic<bool> stop{false};     ///< take no more tasks
  std::atomic<Failure> failure{Failure::none};
  std::array<char, 4096> message{};
};

/// A board in memory that forked processes share.
class SharedBoard {
public:
  SharedBoard()
      : memory_(mmap(nullptr, sizeof(Board), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0)) {
    if (memory_ == MAP_FAILED) throw std::system_error(errno, std::generic_category(), "mmap");
    board_ = new (memory_) Board;
  }
  ~SharedBoard() { munmap(memory_, sizeof(Board)); }
  SharedBoard(const SharedBoard&) = delete;
  SharedBoard& operator=(const SharedBoard&) = delete;

  Board& operator*() const { return *board_; }

private:
  void* memory_;
  Board* board_;
};

volatile std::sig_atomic_t interrupted = 0;

/// While it lives, SIGINT and SIGTERM are only remembered, in `interrupted`.
class InterruptGuard {
public:
  InterruptGuard() {
    interrupted = 0;
    struct sigaction remember {};
    remember.sa_handler = [](int) { interrupted = 1; };
    sigaction(SIGINT, &remember, &old_int_);
    sigaction(SIGTERM, &remember, &old_term_);
  }
  ~InterruptGuard() {
    sigaction(SIGINT, &old_int_, nullptr);
    sigaction(SIGTERM, &old_term_, nullptr);
  }
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

private:
  struct sigaction old_int_ {};
  struct sigaction old_term_ {};
};

void report_failure(Board& board, Failure kind, std::string_view message) {
  Failure none = Failure::none;
  if (board.failure.compare_exchange_strong(none, kind)) {
    message.copy(board.message.data(), board.message.size() - 1);
  }
  board.stop = true;
}

// The life of a worker. Signals are the parent's business; a worker whose parent is gone stops by itself.
void work(Board& board, std::size_t count, const Task& task, pid_t parent) {
  std::signal(SIGINT, SIG_IGN);
  std::signal(SIGTERM, SIG_IGN);
  try {
    while (!board.stop && getppid() == parent) {
      const std::size_t number = board.next++;
      if (number >= count) return;
      task(number);
      ++board.done;
    }
  } catch (const InputError& error) {
    report_failure(board, Failure::bad_input, error.what());
  } catch (const std::exception& error) {
    report_failure(board, Failure::other, error.what());
  }
}

void start_worker(Board& board, std::size_t count, const Task& task) {
  const pid_t parent = getpid();
  const pid_t child = fork();
  if (child < 0) throw std::system_error(errno, std::generic_category(), "fork");
  if (child > 0) return;
  work(board, count, task, parent);
  _exit(0);  // not exit(): what the parent has registered and buffered is the parent's to finish
}

// Buries the workers that have ended; returns how many. One that a signal ended is a failure.
int bury_workers(Board& board) {
  int buried = 0;
  int status = 0;
  while (waitpid(-1, &status, WNOHANG) > 0) {
    ++buried;
    if (WIFSIGNALED(status)) {
      report_failure(board, Failure::other, fmt::format("a worker was ended by signal {}", WTERMSIG(status)));
    }
  }
  return buried;
}

}  // namespace

bool run_in_workers(int jobs, std::size_t count, const Task& task, const Progress& progress) {
  const SharedBoard shared;
  Board& board = *shared;
  const InterruptGuard guard;
  int running = 0;
  for (; running < jobs && static_cast<std::size_t>(running) < count; ++running) {
    start_worker(board, count, task);
  }
  while (running > 0) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    running -= bury_workers(board);
    if (interrupted != 0) board.stop = true;
    progress(board.done);
  }
  if (board.failure == Failure::bad_input) throw InputError({}, board.message.data());
  if (board.failure == Failure::other) throw std::runtime_error(board.message.data());
  return board.done == count;
}

}  // namespace tanglebin
