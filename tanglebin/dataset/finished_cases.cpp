#include "tanglebin/dataset/finished_cases.hpp"

#include <utility>

#include "tanglebin/base/error.hpp"
#include "tanglebin/dataset/journal.hpp"
#include "tanglebin/dataset/safe_file.hpp"

namespace tanglebin {
namespace {

std::filesystem::path manifest_of(const std::filesystem::path& directory) {
  return directory / "manifest.jsonl";
}
std::filesystem::path times_of(const std::filesystem::path& directory) {
  return directory / "times.jsonl";
}

// Between a case's record and its times; JSON escapes a tab inside.
constexpr char separator = '\t';

void add(FinishedCases& finished, CaseRecord record) {
  const CaseId id = record.id;
  finished.records.insert_or_assign(id, std::move(record));
}

void add(FinishedCases& finished, const TimesRecord& times) {
  finished.times.insert_or_assign(times.id, times);
}

// A line for each of the records in the order of `order`.
template <typename Record>
std::string lines_of(const std::map<CaseId, Record>& records, const std::vector<CaseId>& order) {
  std::string lines;
  for (const CaseId& id : order) {
    if (const auto found = records.find(id); found != records.end()) lines += to_json(found->second) + '\n';
  }
  return lines;
}

}  // namespace

std::string journal_line(const CaseRecord& record, const TimesRecord& times) {
  return to_json(record) + separator + to_json(times);
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

std::string times_text(const FinishedCases& finished, const std::vector<CaseId>& order) {
  return lines_of(finished.times, order);
}

void write_manifest(const std::filesystem::path& directory, const FinishedCases& finished,
                    const std::vector<CaseId>& order) {
  write_file(times_of(directory), times_text(finished, order));
  write_file(manifest_of(directory), lines_of(finished.records, order));
  std::filesystem::remove(journal_of(directory));
}

}  // namespace tanglebin
