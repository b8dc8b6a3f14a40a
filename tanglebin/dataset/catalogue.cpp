#include "tanglebin/dataset/catalogue.hpp"

#include <string_view>
#include <utility>

#include "tanglebin/base/error.hpp"
#include "tanglebin/files/json_record.hpp"
#include "tanglebin/files/read_file.hpp"
#include "tanglebin/files/safe_file.hpp"
#include "tanglebin/recipe/case_json.hpp"
#include "tanglebin/runs/journal.hpp"

namespace tanglebin {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view header_start = "{\"made_with\"";

}  // namespace

std::string to_json(const FailedCase& failed) {
  Json json = id_json(failed.id);
  json["seed"] = seed_text(failed.seed);
  json["reason"] = failed.reason;
  return json_text(json);
}

FailedCase failed_case(const std::string& json, const std::string& file, std::size_t line) {
  const JsonRecord value(json, file, line);
  return {id_of(value), value.seed("seed"), value.text("reason")};
}

std::string journal_header(const std::set<Versions>& made_with) {
  return to_json(made_with);
}

std::string journal_line(const CaseRecord& record, const TimesRecord& times) {
  return to_json(record) + journal_separator + to_json(times);
}

bool lists_cases(const fs::path& journal) {
  bool is_there = false;
  for_each_whole_line(journal, [&](const std::string& line, std::size_t) {
    is_there = is_there || !line.starts_with(header_start);
  });
  return is_there;
}

template <typename Take>
void Catalogue::read_lines(const fs::path& file, Damage damage, const Take& take) {
  const std::size_t index = files_.size();
  files_.push_back(file);
  std::uint64_t offset = 0;
  const auto for_each_line = damage == Damage::is_error ? for_each_whole_line : for_each_readable_line;
  for_each_line(file, [&](const std::string& line, std::size_t number) {
    const LinePlace place{index, offset, line.size(), number};
    offset += line.size() + 1;
    take(line, place);
  });
}

Catalogue::Catalogue(const fs::path& directory, Damage damage)
    : Catalogue(directory, damage, DirectoryReadLock(directory)) {}

Catalogue::Catalogue(const fs::path& directory, Damage damage, const DirectoryReadLock& /*held meanwhile*/)
    : Catalogue(directory, damage, journals_in(directory)) {}

Catalogue::Catalogue(const fs::path& directory, Damage damage, const std::vector<fs::path>& journals)
    : directory_(directory), damage_(damage) {
  // To pass over damaged lines, read them all now; otherwise a line is read when it is needed.
  const bool reads_all = damage == Damage::is_passed_over;
  const std::string manifest = (directory / manifest_name).string();
  read_lines(manifest, damage, [&](const std::string& line, const LinePlace& place) {
    const CaseId id =
        reads_all ? case_record(line, manifest, place.line).id : id_of_line(line, manifest, place.line);
    places_[id].record = place;
  });
  const std::string times = (directory / times_name).string();
  read_lines(times, damage, [&](const std::string& line, const LinePlace& place) {
    const CaseId id =
        reads_all ? times_record(line, times, place.line).id : id_of_line(line, times, place.line);
    const auto found = places_.find(id);
    if (found != places_.end()) found->second.times = place;
  });
  const std::string failed = (directory / failed_name).string();
  read_lines(failed, damage, [&](const std::string& line, const LinePlace& place) {
    add(failed_case(line, failed, place.line));
  });
  for (const fs::path& journal : journals) read_journal(journal);
  std::erase_if(failed_, [&](const auto& entry) { return has(entry.first); });
}

void Catalogue::read_journal(const fs::path& file) {
  std::set<Versions> versions;
  read_lines(file, Damage::is_passed_over, [&](const std::string& line, const LinePlace& place) {
    if (line.starts_with(header_start)) {
      versions = tanglebin::made_with(line, file.string(), place.line);
      return;
    }
    const std::size_t middle = line.find(journal_separator);
    if (middle == std::string::npos) {
      add(failed_case(line, file.string(), place.line));
      return;
    }
    LinePlace record = place;
    record.size = middle;
    LinePlace times = place;
    times.offset += middle + 1;
    times.size -= middle + 1;
    times_record(line.substr(middle + 1), file.string(), place.line);
    places_[case_record(line.substr(0, middle), file.string(), place.line).id] = {record, times};
    made_with_.insert(versions.begin(), versions.end());
  });
}

std::vector<CaseId> Catalogue::cases() const {
  std::vector<CaseId> ids;
  ids.reserve(places_.size());
  for (const auto& [id, places] : places_) ids.push_back(id);
  return ids;
}

const Catalogue::Places& Catalogue::places_of(const CaseId& id) const {
  const auto found = places_.find(id);
  if (found == places_.end()) throw InputError({directory_.string(), 0, name_of(id)}, "not listed");
  return found->second;
}

std::string Catalogue::line_at(const CaseId& id, const LinePlace& place, LineReader& reader) const {
  std::string line = reader.line(place);
  const std::string file = files_[place.file].string();
  if (const CaseId found = id_of_line(line, file, place.line); found != id) {
    throw InputError({file, place.line, ""}, name_of(found), name_of(id));
  }
  return line;
}

std::optional<std::string> Catalogue::times_line(const CaseId& id, LineReader& reader) const {
  const LinePlace& place = places_of(id).times;
  if (place.size == 0) return std::nullopt;
  return line_at(id, place, reader);
}

template <typename Read>
auto Catalogue::up_to_date(const Read& read) const {
  try {
    return read(later_ ? *later_ : *this);
  } catch (const InputError&) {
    later_ = std::make_shared<const Catalogue>(directory_, damage_);
    return read(*later_);
  }
}

CaseRecord Catalogue::record(const CaseId& id) const {
  return up_to_date([&](const Catalogue& catalogue) {
    const LinePlace& place = catalogue.places_of(id).record;
    LineReader reader(catalogue.files_);
    return case_record(catalogue.line_at(id, place, reader), catalogue.files_[place.file].string(),
                       place.line);
  });
}

std::optional<TimesRecord> Catalogue::times(const CaseId& id) const {
  return up_to_date([&](const Catalogue& catalogue) -> std::optional<TimesRecord> {
    LineReader reader(catalogue.files_);
    const std::optional<std::string> line = catalogue.times_line(id, reader);
    if (!line) return std::nullopt;
    const LinePlace& place = catalogue.places_of(id).times;
    return times_record(*line, catalogue.files_[place.file].string(), place.line);
  });
}

void Catalogue::for_each_times_line(const std::vector<CaseId>& order,
                                    const std::function<void(const std::string&)>& take) const {
  const Catalogue* read = nullptr;
  std::optional<LineReader> reader;  // of the catalogue that was read last
  const auto times_line_of = [&](const CaseId& id) {
    return up_to_date([&](const Catalogue& catalogue) {
      if (std::exchange(read, &catalogue) != &catalogue) reader.emplace(catalogue.files_);
      return catalogue.times_line(id, *reader);
    });
  };
  for (const CaseId& id : order) {
    if (!has(id)) continue;
    if (const auto line = times_line_of(id)) take(*line);
  }
}

void Catalogue::add(const FailedCase& failed) {
  if (!has(failed.id)) failed_.insert_or_assign(failed.id, failed);
}

DatasetSummary Catalogue::write(const std::vector<CaseId>& order, const std::set<Versions>& made_with,
                                const fs::path& staging) const {
  LineReader reader(files_);
  StagedFile manifest(directory_ / manifest_name, staging);
  StagedFile times(directory_ / times_name, staging);
  DatasetSummary summary{.recipe_cases = order.size(), .made_with = made_with};
  Digest digest;
  std::string failures;
  for (const CaseId& id : order) {
    if (const auto found = places_.find(id); found != places_.end()) {
      const LinePlace& place = found->second.record;
      const std::string line = reader.line(place);
      digest.add(case_record(line, files_[place.file].string(), place.line));
      manifest.append(line + '\n');
      if (found->second.times.size > 0) times.append(reader.line(found->second.times) + '\n');
      ++summary.cases;
    } else if (const auto failed = failed_.find(id); failed != failed_.end()) {
      failures += to_json(failed->second) + '\n';
      ++summary.failed;
    }
  }
  summary.files = digest.files();
  summary.digest = digest.hex();
  times.commit();
  manifest.commit();
  if (failures.empty()) {
    fs::remove(directory_ / failed_name);
  } else {
    write_staged(directory_ / failed_name, failures, staging);
  }
  write_staged(directory_ / summary_name, to_json(summary), staging);
  sync_directory(directory_);
  return summary;
}

}  // namespace tanglebin
