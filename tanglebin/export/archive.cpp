#include "tanglebin/export/archive.hpp"

#include <archive.h>
#include <archive_entry.h>

#include <exception>
#include <stdexcept>
#include <utility>

namespace tanglebin {
namespace {

struct FreeArchive {
  void operator()(archive* writer) const { archive_write_free(writer); }
};
struct FreeEntry {
  void operator()(archive_entry* entry) const { archive_entry_free(entry); }
};

/// Where the bytes go. What the sink throws may not pass through libarchive, which is C.
struct Output {
  Sink sink;
  std::exception_ptr failure{};
};

la_ssize_t write_bytes(archive* /*writer*/, void* data, const void* bytes, std::size_t size) noexcept {
  Output& output = *static_cast<Output*>(data);
  try {
    output.sink({static_cast<const char*>(bytes), size});
    return static_cast<la_ssize_t>(size);
  } catch (...) {
    output.failure = std::current_exception();
    return -1;
  }
}

}  // namespace

struct ArchiveWriter::Implementation {
  Output output;
  std::unique_ptr<archive, FreeArchive> writer{archive_write_new()};

  void expect_done(la_ssize_t result) {
    if (output.failure) std::rethrow_exception(std::exchange(output.failure, nullptr));
    if (result >= ARCHIVE_OK) return;
    const char* what = archive_error_string(writer.get());
    throw std::runtime_error(std::string("libarchive: ") + (what == nullptr ? "failed" : what));
  }
};

ArchiveWriter::ArchiveWriter(Format format, Sink sink)
    : implementation_(std::make_unique<Implementation>(Implementation{.output = {std::move(sink)}})) {
  archive* writer = implementation_->writer.get();
  implementation_->expect_done(format == Format::zip ? archive_write_set_format_zip(writer)
                                                     : archive_write_set_format_ustar(writer));
  if (format == Format::zip)
    implementation_->expect_done(archive_write_set_format_option(writer, "zip", "compression-level", "1"));
  implementation_->expect_done(
      archive_write_open(writer, &implementation_->output, nullptr, write_bytes, nullptr));
}

// The end of an archive that is not closed goes nowhere.
ArchiveWriter::~ArchiveWriter() {
  implementation_->output.sink = [](std::string_view) {};
}

void ArchiveWriter::add(const std::string& name, std::string_view bytes) {
  constexpr int readable_by_all = 0644;
  const std::unique_ptr<archive_entry, FreeEntry> entry(archive_entry_new());
  archive_entry_set_pathname(entry.get(), name.c_str());
  archive_entry_set_filetype(entry.get(), AE_IFREG);
  archive_entry_set_perm(entry.get(), readable_by_all);
  archive_entry_set_size(entry.get(), static_cast<la_int64_t>(bytes.size()));
  archive* writer = implementation_->writer.get();
  implementation_->expect_done(archive_write_header(writer, entry.get()));
  implementation_->expect_done(archive_write_data(writer, bytes.data(), bytes.size()));
  implementation_->expect_done(archive_write_finish_entry(writer));
}

void ArchiveWriter::close() {
  implementation_->expect_done(archive_write_close(implementation_->writer.get()));
}

}  // namespace tanglebin
