#include "tanglebin/dataset/journal.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>

#include "tanglebin/base/error.hpp"
#include "tanglebin/dataset/safe_file.hpp"

namespace tanglebin {
namespace {

std::filesystem::path manifest_of(const std::filesystem::path& directory) {
  return directory / "manifest.jsonl";
}
std::filesystem::path times_of(const std::filesystem::path& directory) {
  return directory / "times.jsonl";
}
std::filesystem::path journal_of(const std::filesystem::path& directory) {
  return directory / "journal.jsonl";
}

// A journal's line is a case's record and its times with a tab between, which JSON escapes inside.
constexpr char separator = '\t';

// Calls `take` with every line that has its end, and the line's number. A file that is not there has none.
void for_each_whole_line(const std::filesystem::path& file,
                         const std::function<void(const std::string&, std::size_t)>& take) {
  std::ifstream in(file, std::ios::binary);
  std::string line;
  for (std::size_t number = 1; std::getline(in, line) && !in.eof(); ++number) take(line, number);
}

void add(FinishedCases& finished, CaseRecord record) {
  const CaseId id = record.id;
  finished.records.insert_or_assign(id, std::move(record));
}

void add(FinishedCases& finished, const TimesRecord& times) {
  finished.times.insert_or_assign(times.id, times);
}

}  // namespace

Journal::Journal(const std::filesystem::path& directory)
    : file_(journal_of(directory)),
      descriptor_(open(file_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666)) {
  if (descriptor_ < 0) throw InputError({file_.string(), 0, ""}, std::strerror(errno));
}

Journal::~Journal() {
  close(descriptor_);
}

void Journal::append(const CaseRecord& record, const TimesRecord& times) const {
  const std::string line = to_json(record) + separator + to_json(times) + '\n';
  const ssize_t written = write(descriptor_, line.data(), line.size());
  if (written < 0) throw InputError({file_.string(), 0, ""}, std::strerror(errno));
  if (static_cast<std::size_t>(written) < line.size())
    throw InputError({file_.string(), 0, ""}, std::strerror(ENOSPC));
  if (fdatasync(descriptor_) != 0) throw InputError({file_.string(), 0, ""}, std::strerror(errno));
}

FinishedCases finished_cases(const std::filesystem::path& directory) {
  FinishedCases finished;
  const std::string manifest = manifest_of(directory).string();
  for_each_whole_line(manifest, [&](const std::string& line, std::size_t number) {
    add(finished, case_record(line, manifest, number));
  });
  const std::string times = times_of(directory).string();
  for_each_whole_line(times, [&](const std::string& line, std::size_t number) {
    add(finished, times_record(line, times, number));
  });
  const std::string journal = journal_of(directory).string();
  for_each_whole_line(journal, [&](const std::string& line, std::size_t number) {
    const std::size_t middle = line.find(separator);
    if (middle == std::string::npos)
      throw InputError({journal, number, ""}, "one part", "a record, a tab and times");
    add(finished, case_record(line.substr(0, middle), journal, number));
    add(finished, times_record(line.substr(middle + 1), journal, number));
  });
  return finished;
}

void write_manifest(const std::filesystem::path& directory, const FinishedCases& finished,
                    const std::vector<CaseId>& order) {
  std::string manifest;
  std::string times;
  for (const CaseId& id : order) {
    if (const auto found = finished.records.find(id); found != finished.records.end()) {
      manifest += to_json(found->second) + '\n';
    }
    if (const auto found = finished.times.find(id); found != finished.times.end()) {
      times += to_json(found->second) + '\n';
    }
  }
  write_file(times_of(directory), times);
  write_file(manifest_of(directory), manifest);
  std::filesystem::remove(journal_of(directory));
}

}  // namespace tanglebin
