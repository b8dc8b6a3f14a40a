#include "tanglebin/runs/line_reader.hpp"

#include "tanglebin/base/error.hpp"
#include "tanglebin/files/read_file.hpp"

namespace tanglebin {

namespace fs = std::filesystem;

LineReader::LineReader(const std::vector<fs::path>& files) {
  files_.reserve(files.size());
  for (const fs::path& file : files) files_.push_back({file, std::nullopt});
}

std::string LineReader::line(const LinePlace& place) {
  std::string line(place.size, '\0');
  auto& [file, in] = files_[place.file];
  if (!in) in = open(file);
  if (!in) throw InputError({file.string(), place.line, ""}, "has been removed");
  in->seekg(static_cast<std::streamoff>(place.offset));
  in->read(line.data(), static_cast<std::streamsize>(line.size()));
  expect_read(*in, file);
  if (!*in) throw InputError({file.string(), place.line, ""}, "is shorter than before");
  return line;
}

std::optional<std::ifstream> LineReader::open(const fs::path& file) {
  constexpr int most_open = 500;
  if (open_ == most_open) {
    for (File& other : files_) other.in.reset();
    open_ = 0;
  }
  ++open_;
  return open_if_there(file);
}

}  // namespace tanglebin
