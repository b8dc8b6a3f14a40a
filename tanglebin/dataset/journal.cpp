#include "tanglebin/dataset/journal.hpp"

#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>
#include <string_view>
#include <system_error>
#include <utility>

#include "tanglebin/base/error.hpp"
#include "tanglebin/dataset/safe_file.hpp"

namespace tanglebin {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view extension = ".jsonl";

std::string stem_of(const std::string& name) {
  return name.empty() ? "journal" : "journal-" + name;
}

fs::path staging_of(const fs::path& journal) {
  return journal.parent_path() / ("." + journal.stem().string() + ".unfinished");
}

FileLock take_lock(const fs::path& file) {
  // Long enough for the workers of a run that was killed to be gone.
  constexpr std::chrono::seconds patience{3};
  if (std::optional<FileLock> lock = FileLock::take(file, patience)) return std::move(*lock);
  throw InputError({file.parent_path().string(), 0, ""}, "another run is writing here");
}

}  // namespace

Journal::Journal(const fs::path& directory, const std::string& name)
    : file_(directory / (stem_of(name) + std::string(extension))),
      staging_(staging_of(file_)),
      lock_(take_lock(file_)) {
  fs::remove_all(staging_);
  make_directories(staging_);
}

Journal::Journal(fs::path file, fs::path staging, FileLock lock)
    : file_(std::move(file)), staging_(std::move(staging)), lock_(std::move(lock)) {}

Journal::~Journal() {
  if (lock_.descriptor() < 0) return;
  std::error_code ignored;
  fs::remove_all(staging_, ignored);
  struct stat status {};
  if (fstat(lock_.descriptor(), &status) == 0 && status.st_size == 0) fs::remove(file_, ignored);
}

void Journal::append(const std::vector<std::string>& lines) const {
  std::string text;
  for (const std::string& line : lines) text += line + '\n';
  const auto fail = [&](int reason) { throw InputError({file_.string(), 0, ""}, std::strerror(reason)); };
  const ssize_t written = write(lock_.descriptor(), text.data(), text.size());
  if (written < 0) fail(errno);
  if (static_cast<std::size_t>(written) < text.size()) fail(ENOSPC);
  if (fdatasync(lock_.descriptor()) != 0) fail(errno);
}

void Journal::clear() const {
  if (ftruncate(lock_.descriptor(), 0) != 0) throw InputError({file_.string(), 0, ""}, std::strerror(errno));
}

std::vector<fs::path> journals_in(const fs::path& directory) {
  std::vector<fs::path> journals;
  for (const fs::directory_entry& entry : fs::directory_iterator(directory)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("journal") && name.ends_with(extension)) journals.push_back(entry.path());
  }
  std::ranges::sort(journals);
  return journals;
}

std::vector<Journal> abandoned_journals(const fs::path& directory) {
  std::vector<Journal> abandoned;
  for (const fs::path& file : journals_in(directory)) {
    if (std::optional<FileLock> lock = FileLock::take(file, std::chrono::milliseconds(0))) {
      abandoned.push_back(Journal(file, staging_of(file), std::move(*lock)));
    }
  }
  return abandoned;
}

void for_each_whole_line(const fs::path& file,
                         const std::function<void(const std::string&, std::size_t)>& take) {
  std::ifstream in(file, std::ios::binary);
  std::string line;
  for (std::size_t number = 1; std::getline(in, line) && !in.eof(); ++number) take(line, number);
}

}  // namespace tanglebin
