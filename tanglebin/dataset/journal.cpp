#include "tanglebin/dataset/journal.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "tanglebin/base/error.hpp"

namespace tanglebin {
namespace {

namespace fs = std::filesystem;

class Journal {
public:
  /// Opens it for this process and those that it forks.
  explicit Journal(const fs::path& file)
      : file_(file), descriptor_(open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666)) {
    if (descriptor_ < 0) throw InputError({file_.string(), 0, ""}, std::strerror(errno));
  }
  ~Journal() { close(descriptor_); }
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// On the disk when it returns. Lines of several processes do not mix.
  void append(const std::string& text) const {
    const std::string line = text + '\n';
    const ssize_t written = write(descriptor_, line.data(), line.size());
    if (written < 0) throw InputError({file_.string(), 0, ""}, std::strerror(errno));
    if (static_cast<std::size_t>(written) < line.size())
      throw InputError({file_.string(), 0, ""}, std::strerror(ENOSPC));
    if (fdatasync(descriptor_) != 0) throw InputError({file_.string(), 0, ""}, std::strerror(errno));
  }

private:
  fs::path file_;
  int descriptor_;
};

}  // namespace

fs::path journal_of(const fs::path& directory) {
  return directory / "journal.jsonl";
}

void for_each_whole_line(const fs::path& file,
                         const std::function<void(const std::string&, std::size_t)>& take) {
  std::ifstream in(file, std::ios::binary);
  std::string line;
  for (std::size_t number = 1; std::getline(in, line) && !in.eof(); ++number) take(line, number);
}

void run_with_journal(const fs::path& directory, int jobs, std::size_t count, const JournaledTask& task,
                      const Progress& progress, const std::function<void()>& finish) {
  try {
    const Journal journal(journal_of(directory));
    run_in_workers(
        jobs, count, [&](std::size_t number) { journal.append(task(number)); }, progress);
  } catch (...) {
    finish();
    throw;
  }
  finish();
}

}  // namespace tanglebin
