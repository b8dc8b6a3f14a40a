#include "tanglebin/dataset/dataset_summary.hpp"

#include "tanglebin/io/json_record.hpp"
#include "tanglebin/io/read_file.hpp"

namespace tanglebin {

void Digest::add(const CaseRecord& record) {
  for (const FileRecord& file : record.files) hash_.add(file.sha256 + "  " + file.path + '\n');
  files_ += record.files.size();
}

std::string to_json(const DatasetSummary& summary) {
  Json json{{"cases", summary.cases},
            {"recipe_cases", summary.recipe_cases},
            {"failed", summary.failed},
            {"files", summary.files},
            {"digest", summary.digest}};
  json["made_with"] = Json::array();
  for (const Versions& versions : summary.made_with) {
    Json names = Json::object();
    for (const auto& [name, version] : versions) names[name] = version;
    json["made_with"].push_back(names);
  }
  return json.dump(2) + '\n';
}

std::optional<DatasetSummary> read_dataset_summary(const std::filesystem::path& directory) {
  const std::filesystem::path file = directory / "dataset.json";
  const std::optional<std::string> text = read_if_there(file);
  if (!text) return std::nullopt;
  const JsonRecord json(*text, file.string(), 0);
  DatasetSummary summary{json.whole_number("cases"),  json.whole_number("recipe_cases"),
                         json.whole_number("failed"), json.whole_number("files"),
                         json.text("digest"),         {}};
  for (const JsonRecord& versions : json.objects("made_with")) {
    Versions names;
    for (const std::string& name : versions.fields()) names[name] = versions.text(name);
    summary.made_with.insert(std::move(names));
  }
  return summary;
}

}  // namespace tanglebin
