#include "tanglebin/report/process.hpp"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <system_error>

namespace tanglebin {
namespace {

[[noreturn]] void fail(int error, const std::string& what) {
  throw std::system_error(error, std::generic_category(), what);
}

/// A file without a name, which is deleted when closed. Unlike a pipe, it takes any number of bytes at once,
/// so neither side waits for the other.
class NamelessFile {
public:
  NamelessFile() : file_(std::tmpfile()) {
    if (!file_) fail(errno, "cannot create a temporary file");
  }

  int descriptor() const { return fileno(file_.get()); }

  void fill(const std::string& bytes) const {
    if (std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size() ||
        std::fflush(file_.get()) != 0) {
      fail(errno, "cannot write a temporary file");
    }
    std::rewind(file_.get());
  }

  std::string bytes() const {
    std::rewind(file_.get());
    std::string result;
    std::array<char, 1 << 16> block;
    while (const std::size_t count = std::fread(block.data(), 1, block.size(), file_.get())) {
      result.append(block.data(), count);
    }
    return result;
  }

private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::unique_ptr<std::FILE, Close> file_;
};

/// Redirects a process's standard input, output and error.
class FileActions {
public:
  FileActions(const NamelessFile& in, const NamelessFile& out, const NamelessFile& err) {
    posix_spawn_file_actions_init(&actions_);
    posix_spawn_file_actions_adddup2(&actions_, in.descriptor(), STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions_, out.descriptor(), STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions_, err.descriptor(), STDERR_FILENO);
  }
  ~FileActions() { posix_spawn_file_actions_destroy(&actions_); }
  FileActions(const FileActions&) = delete;
  FileActions& operator=(const FileActions&) = delete;

  const posix_spawn_file_actions_t* get() const { return &actions_; }

private:
  posix_spawn_file_actions_t actions_{};
};

pid_t start(std::vector<std::string> command, const FileActions& files) {
  std::vector<char*> arguments;
  arguments.reserve(command.size() + 1);
  for (std::string& argument : command) arguments.push_back(argument.data());
  arguments.push_back(nullptr);
  std::string locale = "LC_ALL=C.UTF-8";
  const std::array<char*, 2> environment = {locale.data(), nullptr};
  pid_t process = 0;
  const int error =
      posix_spawnp(&process, arguments.front(), files.get(), nullptr, arguments.data(), environment.data());
  if (error != 0) fail(error, "cannot start " + command.front());
  return process;
}

int wait_for(pid_t process) {
  int status = 0;
  while (waitpid(process, &status, 0) < 0) {
    if (errno != EINTR) fail(errno, "cannot wait for a process");
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace

ProcessResult run_process(const std::vector<std::string>& command, const std::string& input) {
  const NamelessFile in;
  const NamelessFile out;
  const NamelessFile err;
  in.fill(input);
  const int status = wait_for(start(command, FileActions(in, out, err)));
  return {.status = status, .out = out.bytes(), .err = err.bytes()};
}

}  // namespace tanglebin
