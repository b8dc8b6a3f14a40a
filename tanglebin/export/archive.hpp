#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace tanglebin {

/// Takes the bytes of a file piece by piece.
using Sink = std::function<void(std::string_view)>;

/// Writes an archive of files by libarchive. The same files give the same bytes: they have neither times nor
/// owners.
class ArchiveWriter {
public:
  enum class Format {
    zip,  ///< deflated
    tar   ///< ustar
  };

  /// Throws std::runtime_error if libarchive fails, as do the other functions, and what the sink throws.
  ArchiveWriter(Format format, Sink sink);
  ~ArchiveWriter();
  ArchiveWriter(const ArchiveWriter&) = delete;
  ArchiveWriter& operator=(const ArchiveWriter&) = delete;

  void add(const std::string& name, std::string_view bytes);

  /// Writes the end. Nothing can be added any more.
  void close();

private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace tanglebin
