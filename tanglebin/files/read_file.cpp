#include "tanglebin/files/read_file.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <istream>
#include <memory>
#include <system_error>
#include <utility>

#include "tanglebin/base/error.hpp"

namespace tanglebin {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t longest_line = std::size_t{1} << 26U;

[[noreturn]] void fail(const fs::path& file, const std::string& what, int reason) {
  throw InputError({file.string(), 0, ""}, what + ": " + std::strerror(reason));
}

std::string kind_of(fs::file_type type) {
  switch (type) {
    case fs::file_type::directory:
      return "a directory";
    case fs::file_type::fifo:
      return "a pipe";
    case fs::file_type::character:
    case fs::file_type::block:
      return "a device";
    default:
      return "something else";
  }
}

void expect_regular(const fs::path& file) {
  std::error_code ignored;  // opening reports it
  const fs::file_type type = fs::status(file, ignored).type();
  const bool may_be_opened =
      type == fs::file_type::regular || type == fs::file_type::not_found || type == fs::file_type::none;
  if (!may_be_opened) throw InputError({file.string(), 0, ""}, kind_of(type), "a regular file");
}

}  // namespace

std::optional<std::ifstream> open_if_there(const fs::path& file) {
  expect_regular(file);
  std::ifstream in(file, std::ios::binary);
  if (in) return in;
  if (errno == ENOENT) return std::nullopt;
  fail(file, "cannot be opened", errno);
}

std::ifstream open_input(const fs::path& file) {
  std::error_code ignored;  // opening reports it
  if (fs::is_directory(file, ignored)) throw InputError({file.string(), 0, ""}, "is a directory");
  std::ifstream in(file, std::ios::binary);
  if (!in) fail(file, "cannot be opened", errno);
  return in;
}

void expect_read(const std::ifstream& in, const fs::path& file) {
  if (in.bad()) fail(file, "cannot be read", errno);
}

std::string read_bytes(std::istream& in, const std::string& name, std::size_t most) {
  std::string bytes;
  std::array<char, 65536> part{};
  while (in && bytes.size() <= most) {
    in.read(part.data(), static_cast<std::streamsize>(part.size()));
    bytes.append(part.data(), static_cast<std::size_t>(in.gcount()));
  }
  if (bytes.size() > most) throw InputError({name, 0, ""}, "more bytes", fmt::format("at most {}", most));
  return bytes;
}

std::optional<std::string> read_if_there(const fs::path& file, std::size_t most) {
  std::optional<std::ifstream> in = open_if_there(file);
  if (!in) return std::nullopt;
  std::string bytes = read_bytes(*in, file.string(), most);
  expect_read(*in, file);
  return bytes;
}

std::string read_file(const fs::path& file, std::size_t most) {
  std::optional<std::string> bytes = read_if_there(file, most);
  if (!bytes) fail(file, "cannot be opened", ENOENT);
  return std::move(*bytes);
}

void for_each_line(const fs::path& file, const std::function<void(const FileLine&)>& take) {
  std::optional<std::ifstream> in = open_if_there(file);
  if (!in) return;
  // Not zeroed, so the system provides only the memory that lines use.
  // NOLINTNEXTLINE(modernize-avoid-c-arrays): std::vector<char> would be zeroed
  const auto buffer = std::make_unique_for_overwrite<char[]>(longest_line);
  std::string text;
  std::size_t number = 1;
  for (; in->getline(buffer.get(), static_cast<std::streamsize>(longest_line)); ++number) {
    const bool is_whole = !in->eof();
    text.assign(buffer.get(), static_cast<std::size_t>(in->gcount()) - (is_whole ? 1 : 0));
    take({text, number, is_whole});
  }
  expect_read(*in, file);
  if (in->gcount() > 0) {
    throw InputError({file.string(), number, ""}, fmt::format("a line of {} bytes or more", longest_line),
                     "a shorter one");
  }
}

}  // namespace tanglebin
