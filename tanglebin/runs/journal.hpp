#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "tanglebin/runs/file_lock.hpp"

namespace tanglebin {

/// The journal of a run in a directory: a line for each task that is done but not yet in the directory's
/// other files. It stays behind when the run ends, until its lines are in these files. A run keeps its
/// journal locked, so only one run of a name can be in a directory at a time; runs of different names may
/// work side by side. A journal has a directory beside it for unfinished files.
class Journal {
public:
  /// Opens the journal `directory`/journal.jsonl, or journal-NAME.jsonl for a name such as "2-of-8", for this
  /// process and its forks. It keeps the whole lines that an earlier run left. Throws SystemError if another
  /// run still has it after a few seconds, or two minutes if it has a name.
  explicit Journal(const std::filesystem::path& directory, const std::string& name = {});

  /// Removes the directory for unfinished files, and the journal if it is empty.
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  const std::filesystem::path& file() const { return file_; }

  /// A directory on the same disk for unfinished files; empty at first.
  const std::filesystem::path& staging() const { return staging_; }

  /// The lines are on the disk when it returns. Throws SystemError if that fails ("No space left on device",
  /// …).
  void append(const std::vector<std::string>& lines) const;

  /// Empties the journal, once its lines are in other files on the disk.
  void clear() const;

private:
  std::filesystem::path file_;
  std::filesystem::path staging_;
  FileLock lock_;
};

/// All journals in the directory, locked or not: files with a journal's name that are no symbolic links.
std::vector<std::filesystem::path> journals_in(const std::filesystem::path& directory);

/// What else is in the directory, but for hidden files. Other runs may begin at the same time: their journals
/// are never among it.
std::set<std::filesystem::path> besides_journals(const std::filesystem::path& directory);

/// Those of the journals whose runs are in progress.
std::vector<std::filesystem::path> journals_in_use(const std::vector<std::filesystem::path>& journals);

/// Removes the journal of a run that has ended, with its directory for unfinished files.
void remove_journal(const std::filesystem::path& journal);

/// Calls `take` with every whole line of the file and its number; skips a last line without an end. A missing
/// file has no lines. Throws InputError for a file that cannot be read.
void for_each_whole_line(const std::filesystem::path& file,
                         const std::function<void(const std::string&, std::size_t)>& take);

/// The same, but also skips lines for which `take` throws InputError. Journals are read this way: after a
/// power cut, lines that were not yet on the disk may have any bytes, and their tasks are done again.
void for_each_readable_line(const std::filesystem::path& file,
                            const std::function<void(const std::string&, std::size_t)>& take);

}  // namespace tanglebin
