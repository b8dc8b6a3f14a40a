#include "tanglebin/export/export_files.hpp"

#include <utility>

#include "tanglebin/files/safe_file.hpp"

namespace tanglebin {

namespace fs = std::filesystem;

ExportFiles::ExportFiles(fs::path directory, fs::path staging)
    : directory_(std::move(directory)), staging_(std::move(staging)) {}

void ExportFiles::write(const std::string& path, std::string_view bytes) {
  const fs::path file = directory_ / path;
  expect_below(directory_, file);
  make_directories(file.parent_path());
  write_staged(file, bytes, staging_);
  folders_.insert(file.parent_path());
}

void ExportFiles::seal(const std::string& path, const std::function<void(const Sink&)>& produce) {
  const fs::path file = directory_ / path;
  expect_below(directory_, file);
  make_directories(file.parent_path());
  StagedFile staged(file, staging_);
  produce([&](std::string_view bytes) { staged.append(bytes); });
  sync_folders();
  staged.commit();
  sync_directory(file.parent_path());
}

void ExportFiles::seal(const std::string& path, std::string_view bytes) {
  seal(path, [&](const Sink& sink) { sink(bytes); });
}

void ExportFiles::sync_folders() {
  for (const fs::path& folder : folders_) sync_directory(folder);
  folders_.clear();
}

}  // namespace tanglebin
