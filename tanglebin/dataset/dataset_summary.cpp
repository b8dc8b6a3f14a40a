#include "tanglebin/dataset/dataset_summary.hpp"

#include <fstream>
#include <iterator>

#include "tanglebin/dataset/json_line.hpp"

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
  std::ifstream in(file, std::ios::binary);
  if (!in) return std::nullopt;
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  return read_json_line(text, file.string(), 0, [](const Json& json) {
    DatasetSummary summary{
        integer_from<std::size_t>(json.at("cases")),  integer_from<std::size_t>(json.at("recipe_cases")),
        integer_from<std::size_t>(json.at("failed")), integer_from<std::size_t>(json.at("files")),
        json.at("digest").get<std::string>(),         {}};
    for (const Json& versions : json.at("made_with")) {
      Versions names;
      for (const auto& [name, version] : versions.items()) names[name] = version.get<std::string>();
      summary.made_with.insert(std::move(names));
    }
    return summary;
  });
}

}  // namespace tanglebin
