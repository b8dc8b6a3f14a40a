#include "tanglebin/dataset/catalogue.hpp"

#include <fstream>
#include <string_view>
#include <utility>

#include "tanglebin/base/error.hpp"
#include "tanglebin/dataset/finished_cases.hpp"
#include "tanglebin/dataset/journal.hpp"
#include "tanglebin/dataset/json_line.hpp"
#include "tanglebin/dataset/safe_file.hpp"

namespace tanglebin {
namespace {

namespace fs = std::filesystem;

// Every line begins with these three members, and a set's name has neither comma nor quote. Only so much is
// read: a manifest may have a hundred thousand lines.
CaseId id_of_line(std::string_view line, const std::string& file, std::size_t number) {
  std::size_t end = std::string_view::npos;
  std::size_t from = 0;
  for (int members = 0; members < 3; ++members) {
    end = line.find_first_of(",}", from);
    from = end == std::string_view::npos ? end : end + 1;
  }
  return read_json_line(std::string(line.substr(0, end)) + '}', file, number, id_from);
}

}  // namespace

std::string to_json(const FailedCase& failed) {
  Json json = id_json(failed.id);
  json["seed"] = seed_text(failed.seed);
  json["reason"] = failed.reason;
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

FailedCase failed_case(const std::string& json, const std::string& file, std::size_t line) {
  return read_json_line(json, file, line, [](const Json& value) {
    return FailedCase{id_from(value), seed_from(value.at("seed")), value.at("reason").get<std::string>()};
  });
}

/// Fetches lines from where they are.
class Catalogue::Reader {
public:
  explicit Reader(const std::vector<fs::path>& files) {
    files_.reserve(files.size());
    for (const fs::path& file : files) files_.push_back({file, {}});
  }

  std::string line(const Place& place) {
    std::string line(place.size, '\0');
    auto& [file, in] = files_[place.file];
    if (!in.is_open()) in.open(file, std::ios::binary);
    in.seekg(static_cast<std::streamoff>(place.offset));
    in.read(line.data(), static_cast<std::streamsize>(line.size()));
    return line;
  }

private:
  struct File {
    fs::path path;
    std::ifstream in;
  };
  std::vector<File> files_;
};

template <typename Take>
void Catalogue::read_lines(const fs::path& file, const Take& take) {
  const std::size_t index = files_.size();
  files_.push_back(file);
  std::uint64_t offset = 0;
  for_each_whole_line(file, [&](const std::string& line, std::size_t number) {
    const Place place{index, offset, line.size(), number};
    offset += line.size() + 1;
    try {
      take(line, place);
    } catch (const InputError&) {
      if (damage_ == Damage::is_error) throw;
    }
  });
}

Catalogue::Catalogue(const fs::path& directory, Damage damage) : directory_(directory), damage_(damage) {
  const auto id_of = [&](const std::string& line, const Place& place) {
    return id_of_line(line, files_[place.file].string(), place.line);
  };
  read_lines(directory / manifest_name, [&](const std::string& line, const Place& place) {
    places_[id_of(line, place)].record = place;
  });
  read_lines(directory / times_name, [&](const std::string& line, const Place& place) {
    const auto found = places_.find(id_of(line, place));
    if (found != places_.end()) found->second.times = place;
  });
  read_lines(directory / failed_name, [&](const std::string& line, const Place& place) {
    add(failed_case(line, files_[place.file].string(), place.line));
  });
  for (const fs::path& journal : journals_in(directory)) read_journal(journal);
  std::erase_if(failed_, [&](const auto& entry) { return has(entry.first); });
}

void Catalogue::read_journal(const fs::path& file) {
  read_lines(file, [&](const std::string& line, const Place& place) {
    has_journaled_ = true;
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
    places_[id_of_line(line, file.string(), place.line)] = {record, times};
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
  return case_record(Reader(files_).line(place), files_[place.file].string(), place.line);
}

std::optional<TimesRecord> Catalogue::times(const CaseId& id) const {
  const Place& place = places_.at(id).times;
  if (place.size == 0) return std::nullopt;
  return times_record(Reader(files_).line(place), files_[place.file].string(), place.line);
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
