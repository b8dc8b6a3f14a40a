#include "tanglebin/dataset/finished_cases.hpp"

#include <utility>

#include "tanglebin/runs/journal.hpp"

namespace tanglebin {
namespace {

void add(FinishedCases& finished, CaseRecord record) {
  const CaseId id = record.id;
  finished.records.insert_or_assign(id, std::move(record));
}

void add(FinishedCases& finished, const TimesRecord& times) {
  finished.times.insert_or_assign(times.id, times);
}

}  // namespace

std::string journal_line(const CaseRecord& record, const TimesRecord& times) {
  return to_json(record) + journal_separator + to_json(times);
}

FinishedCases finished_cases(const std::filesystem::path& directory) {
  FinishedCases finished;
  const std::string manifest = (directory / manifest_name).string();
  for_each_whole_line(manifest, [&](const std::string& line, std::size_t number) {
    add(finished, case_record(line, manifest, number));
  });
  const std::string times = (directory / times_name).string();
  for_each_whole_line(times, [&](const std::string& line, std::size_t number) {
    add(finished, times_record(line, times, number));
  });
  for (const std::filesystem::path& journal : journals_in(directory)) {
    for_each_readable_line(journal, [&](const std::string& line, std::size_t number) {
      const std::size_t middle = line.find(journal_separator);
      if (middle == std::string::npos) return;  // a case that failed
      CaseRecord record = case_record(line.substr(0, middle), journal.string(), number);
      const TimesRecord took = times_record(line.substr(middle + 1), journal.string(), number);
      add(finished, std::move(record));
      add(finished, took);
    });
  }
  return finished;
}

std::string times_text(const FinishedCases& finished, const std::vector<CaseId>& order) {
  std::string lines;
  for (const CaseId& id : order) {
    if (const auto found = finished.times.find(id); found != finished.times.end())
      lines += to_json(found->second) + '\n';
  }
  return lines;
}

}  // namespace tanglebin
