#include "tanglebin/io/read_file.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include "tanglebin/base/error.hpp"

namespace tanglebin {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& file, const std::string& what, int reason) {
  throw InputError({file.string(), 0, ""}, what + ": " + std::strerror(reason));
}

}  // namespace

std::optional<std::ifstream> open_if_there(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (in) return in;
  if (errno == ENOENT) return std::nullopt;
  fail(file, "cannot be opened", errno);
}

void expect_read(const std::ifstream& in, const fs::path& file) {
  if (in.bad()) fail(file, "cannot be read", errno);
}

std::optional<std::string> read_if_there(const fs::path& file, std::size_t most) {
  std::optional<std::ifstream> in = open_if_there(file);
  if (!in) return std::nullopt;
  std::string bytes;
  std::array<char, 65536> part{};
  while (*in && bytes.size() < most) {
    in->read(part.data(), static_cast<std::streamsize>(std::min(part.size(), most - bytes.size())));
    bytes.append(part.data(), static_cast<std::size_t>(in->gcount()));
  }
  expect_read(*in, file);
  return bytes;
}

std::string read_file(const fs::path& file, std::size_t most) {
  std::optional<std::string> bytes = read_if_there(file, most);
  if (!bytes) fail(file, "cannot be opened", ENOENT);
  return std::move(*bytes);
}

}  // namespace tanglebin
