#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tanglebin/runs/file_lock.hpp"

namespace tanglebin {

/// The journal of a run in a directory: a line for each task that is done and not yet in the directory's
/// other files. A run that is cut off leaves it behind; the next one reads it. A run keeps its journal
/// locked, so that there is one run of a name in a directory at a time; those of different names may be there
/// side by side. A journal has a directory beside it for files that are not finished.
class Journal {
public:
  /// Opens the journal `directory`/journal.jsonl, or journal-NAME.jsonl where there is a name ("2-of-8"), for
  /// this process and those that it forks, with the whole lines that an earlier run left. Throws InputError
  /// where another run has it for longer than this one waits: a few seconds, two minutes where it has a name.
  explicit Journal(const std::filesystem::path& directory, const std::string& name = {});

  /// Removes the directory for unfinished files, and the journal where it is empty.
  ~Journal();
  Journal(Journal&&) = default;
  Journal& operator=(Journal&&) = delete;

  const std::filesystem::path& file() const { return file_; }

  /// Whether it has no lines.
  bool is_empty() const;

  /// A directory on the same disk for files that are not finished; empty at first.
  const std::filesystem::path& staging() const { return staging_; }

  /// On the disk when it returns. Throws InputError where that fails ("No space left on device", …).
  void append(const std::vector<std::string>& lines) const;

  /// Empties the journal: what its lines say stands elsewhere, on the disk.
  void clear() const;

private:
  friend std::vector<Journal> abandoned_journals(const std::filesystem::path& directory);
  Journal(std::filesystem::path file, std::filesystem::path staging, FileLock lock);

  std::filesystem::path file_;
  std::filesystem::path staging_;
  FileLock lock_;
};

/// The directory's journals, whoever has them: files that are called as Journal calls them, and no symbolic
/// links.
std::vector<std::filesystem::path> journals_in(const std::filesystem::path& directory);

/// Those of runs that were cut off.
std::vector<Journal> abandoned_journals(const std::filesystem::path& directory);

/// Calls `take` with every line of the file that has its end, and the line's number: a last line that was cut
/// off is passed over. A file that is not there has no lines; throws InputError for one that cannot be read.
void for_each_whole_line(const std::filesystem::path& file,
                         const std::function<void(const std::string&, std::size_t)>& take);

/// The same, but lines for which `take` throws InputError are passed over. So journals are read: after a
/// power cut, lines that a run did not yet rely on may have any bytes, and their tasks are done again.
void for_each_readable_line(const std::filesystem::path& file,
                            const std::function<void(const std::string&, std::size_t)>& take);

}  // namespace tanglebin
