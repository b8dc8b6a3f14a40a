#include "tanglebin/runs/journal.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <fstream>
#include <iterator>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>

#include "tanglebin/base/error.hpp"
#include "tanglebin/files/read_file.hpp"
#include "tanglebin/files/safe_file.hpp"

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

// Together with the directory: a run that removes journals of ended runs has locked that.
std::optional<FileLock> take_lock(const fs::path& file) {
  const DirectoryLock lock(file.parent_path());
  return FileLock::take(file);
}

FileLock wait_for_lock(const fs::path& file, std::chrono::seconds patience) {
  const auto end = std::chrono::steady_clock::now() + patience;
  while (true) {
    if (std::optional<FileLock> lock = take_lock(file)) return std::move(*lock);
    if (std::chrono::steady_clock::now() >= end) {
      throw SystemError(file.parent_path().string(), "another run is writing here");
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
  }
}

std::chrono::seconds patience_of(const std::string& name) {
  // Long enough for the workers of a killed run to end.
  constexpr std::chrono::seconds on_one_machine{3};
  // Long enough for a file server to release the locks of a machine that died.
  constexpr std::chrono::seconds on_a_cluster{120};
  return name.empty() ? on_one_machine : on_a_cluster;
}

// An interrupted run may have left a torn line; the next line must not continue it.
void cut_torn_line(const fs::path& file) {
  std::uintmax_t whole = 0;
  for_each_whole_line(file, [&](const std::string& line, std::size_t) { whole += line.size() + 1; });
  std::error_code error;
  fs::resize_file(file, whole, error);
  if (error) throw_refusal(file, "cannot write", error);
}

fs::path journal_of(const fs::path& directory, const std::string& name) {
  return directory / (stem_of(name) + std::string(extension));
}

}  // namespace

Journal::Journal(const fs::path& directory, const std::string& name)
    : file_(journal_of(directory, name)),
      staging_(staging_of(file_)),
      lock_(wait_for_lock(file_, patience_of(name))) {
  cut_torn_line(file_);
  fs::remove_all(staging_);
  make_directories(staging_);
}

Journal::~Journal() {
  std::error_code ignored;
  fs::remove_all(staging_, ignored);
  if (fs::file_size(file_, ignored) == 0) fs::remove(file_, ignored);
}

void Journal::append(const std::vector<std::string>& lines) const {
  std::string text;
  for (const std::string& line : lines) text += line + '\n';
  write_all(lock_.descriptor(), text, file_);
  if (fdatasync(lock_.descriptor()) != 0) throw_refusal(file_, "cannot write", last_error());
}

void Journal::clear() const {
  if (ftruncate(lock_.descriptor(), 0) != 0) throw_refusal(file_, "cannot write", last_error());
}

std::vector<fs::path> journals_in(const fs::path& directory) {
  std::vector<fs::path> journals;
  for (const fs::directory_entry& entry : fs::directory_iterator(directory)) {
    const std::string name = entry.path().filename().string();
    const bool is_journal = name == stem_of({}) + std::string(extension) ||
                            (name.starts_with("journal-") && name.ends_with(extension));
    if (is_journal && fs::is_regular_file(entry.symlink_status())) journals.push_back(entry.path());
  }
  std::ranges::sort(journals);
  return journals;
}

// The journals are listed after all else: one that comes in between is in neither list, or in both.
std::set<fs::path> besides_journals(const fs::path& directory) {
  if (!fs::is_directory(directory)) return {};
  std::set<fs::path> others;
  for (const fs::directory_entry& entry : fs::directory_iterator(directory)) {
    const bool is_hidden = entry.path().filename().string().starts_with('.');
    if (!is_hidden) others.insert(entry.path());
  }
  for (const fs::path& journal : journals_in(directory)) others.erase(journal);
  return others;
}

std::vector<fs::path> journals_in_use(const std::vector<fs::path>& journals) {
  std::vector<fs::path> in_use;
  std::ranges::copy_if(journals, std::back_inserter(in_use), is_locked);
  return in_use;
}

void remove_journal(const fs::path& journal) {
  fs::remove_all(staging_of(journal));
  fs::remove(journal);
}

void for_each_whole_line(const fs::path& file,
                         const std::function<void(const std::string&, std::size_t)>& take) {
  for_each_line(file, [&](const FileLine& line) {
    if (line.is_whole) take(line.text, line.number);
  });
}

void for_each_readable_line(const fs::path& file,
                            const std::function<void(const std::string&, std::size_t)>& take) {
  for_each_whole_line(file, [&](const std::string& line, std::size_t number) {
    try {
      take(line, number);
    } catch (const InputError&) {
      return;
    }
  });
}

}  // namespace tanglebin
