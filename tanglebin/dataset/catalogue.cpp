#include "tanglebin/dataset/catalogue.hpp"

#include <fstream>
#include <utility>

#include "tanglebin/base/error.hpp"
#include "tanglebin/io/json_record.hpp"
#include "tanglebin/io/read_file.hpp"
#include "tanglebin/io/safe_file.hpp"
#include "tanglebin/recipe/case_json.hpp"
#include "tanglebin/runs/journal.hpp"

namespace tanglebin {

namespace fs = std::filesystem;

std::string to_json(const FailedCase& failed) {
  Json json = id_json(failed.id);
  json["seed"] = seed_text(failed.seed);
  json["reason"] = failed.reason;
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

FailedCase failed_case(const std::string& json, const std::string& file, std::size_t line) {
  const JsonRecord value(json, file, line);
  return {id_of(value), value.seed("seed"), value.text("reason")};
}

std::string journal_line(const CaseRecord& record, const TimesRecord& times) {
  return to_json(record) + journal_separator + to_json(times);
}

/// Reads lines by their places.
class Catalogue::Reader {
public:
  explicit Reader(const std::vector<fs::path>& files) {
    files_.reserve(files.size());
    for (const fs::path& file : files) files_.push_back({file, std::nullopt});
  }

  std::string line(const Place& place) {
    std::string line(place.size, '\0');
    auto& [file, in] = files_[place.file];
    if (!in) in = open_if_there(file);
    if (!in) throw InputError({file.string(), place.line, ""}, "has been removed");
    in->seekg(static_cast<std::streamoff>(place.offset));
    in->read(line.data(), static_cast<std::streamsize>(line.size()));
    expect_read(*in, file);
    if (!*in) throw InputError({file.string(), place.line, ""}, "is shorter than before");
    return line;
  }

private:
  struct File {
    fs::path path;
    std::optional<std::ifstream> in;
  };
  std::vector<File> files_;
};

template <typename Take>
void Catalogue::read_lines(const fs::path& file, Damage damage, const Take& take) {
  const std::size_t index = files_.size();
  files_.push_back(file);
  std::uint64_t offset = 0;
  const auto for_each_line = damage == Damage::is_error ? for_each_whole_line : for_each_readable_line;
  for_each_line(file, [&](const std::string& line, std::size_t number) {
    const Place place{index, offset, line.size(), number};
    offset += line.size() + 1;
    take(line, place);
  });
}

Catalogue::Catalogue(const fs::path& directory, Damage damage)
    : Catalogue(directory, damage, journals_in(directory)) {}

Catalogue::Catalogue(const fs::path& directory, Damage damage, const std::vector<fs::path>& journals)
    : directory_(directory) {
  // To pass over damaged lines, read them all now; otherwise a line is read when it is needed.
  const bool reads_all = damage == Damage::is_passed_over;
  const std::string manifest = (directory / manifest_name).string();
  read_lines(manifest, damage, [&](const std::string& line, const Place& place) {
    const CaseId id =
        reads_all ? case_record(line, manifest, place.line).id : id_of_line(line, manifest, place.line);
    places_[id].record = place;
  });
  const std::string times = (directory / times_name).string();
  read_lines(times, damage, [&](const std::string& line, const Place& place) {
    const CaseId id =
        reads_all ? times_record(line, times, place.line).id : id_of_line(line, times, place.line);
    const auto found = places_.find(id);
    if (found != places_.end()) found->second.times = place;
  });
  const std::string failed = (directory / failed_name).string();
  read_lines(failed, damage, [&](const std::string& line, const Place& place) {
    add(failed_case(line, failed, place.line));
  });
  for (const fs::path& journal : journals) read_journal(journal);
  std::erase_if(failed_, [&](const auto& entry) { return has(entry.first); });
}

void Catalogue::read_journal(const fs::path& file) {
  read_lines(file, Damage::is_passed_over, [&](const std::string& line, const Place& place) {
    const std::size_t middle = line.find(journal_separator);
    if (middle == std::string::npos) {
      add(failed_case(line, file.string(), place.line));
      return;
    }
    Place record = place;
    record.size = middle;
    Place times = place;
    times.offset += middle + 1;
    times.size -= middle + 1;
    times_record(line.substr(middle + 1), file.string(), place.line);
    places_[case_record(line.substr(0, middle), file.string(), place.line).id] = {record, times};
  });
}

std::vector<CaseId> Catalogue::cases() const {
  std::vector<CaseId> ids;
  ids.reserve(places_.size());
  for (const auto& [id, places] : places_) ids.push_back(id);
  return ids;
}

CaseRecord Catalogue::record(const CaseId& id) const {
  const Place& place = places_.at(id).record;
  CaseRecord record = case_record(Reader(files_).line(place), files_[place.file].string(), place.line);
  // A run that goes on meanwhile may have replaced the file.
  if (record.id != id)
    throw InputError({files_[place.file].string(), place.line, ""}, name_of(record.id), name_of(id));
  return record;
}

std::optional<TimesRecord> Catalogue::times(const CaseId& id) const {
  const Place& place = places_.at(id).times;
  if (place.size == 0) return std::nullopt;
  return times_record(Reader(files_).line(place), files_[place.file].string(), place.line);
}

void Catalogue::for_each_times_line(const std::vector<CaseId>& order,
                                    const std::function<void(const std::string&)>& take) const {
  Reader reader(files_);
  for (const CaseId& id : order) {
    const auto found = places_.find(id);
    if (found != places_.end() && found->second.times.size > 0) take(reader.line(found->second.times));
  }
}

void Catalogue::add(const FailedCase& failed) {
  if (!has(failed.id)) failed_.insert_or_assign(failed.id, failed);
}

DatasetSummary Catalogue::write(const std::vector<CaseId>& order, const std::set<Versions>& made_with,
                                const fs::path& staging) const {
  Reader reader(files_);
  StagedFile manifest(directory_ / manifest_name, staging);
  StagedFile times(directory_ / times_name, staging);
  DatasetSummary summary{.recipe_cases = order.size(), .made_with = made_with};
  Digest digest;
  std::string failures;
  for (const CaseId& id : order) {
    if (const auto found = places_.find(id); found != places_.end()) {
      const Place& place = found->second.record;
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
  write_staged(directory_ / "dataset.json", to_json(summary), staging);
  sync_directory(directory_);
  return summary;
}

}  // namespace tanglebin
