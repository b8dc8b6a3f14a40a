#include "tanglebin/io/cloud_input.hpp"

#include <fmt/core.h>

#include <istream>

namespace tanglebin::cloud_format {

std::optional<std::string_view> CloudInput::next_line() {
  stream_.getline(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
  auto length = static_cast<std::size_t>(stream_.gcount());
  if (stream_.fail() && length == 0) return std::nullopt;
  ++line_;
  if (stream_.fail()) throw InputError(place(), fmt::format("line longer than {} bytes", length));
  if (!stream_.eof()) --length;  // the line feed is counted but not stored
  std::string_view line(buffer_.data(), length);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

std::size_t CloudInput::read(std::byte* to, std::size_t size) {
  stream_.read(reinterpret_cast<char*>(to), static_cast<std::streamsize>(size));
  return static_cast<std::size_t>(stream_.gcount());
}

std::size_t CloudInput::skip(std::size_t size) {
  stream_.ignore(static_cast<std::streamsize>(size));
  return static_cast<std::size_t>(stream_.gcount());
}

bool CloudInput::at_end() {
  return stream_.peek() == std::istream::traits_type::eof();
}

std::size_t CloudInput::remaining() {
  const std::istream::pos_type here = stream_.tellg();
  if (here == std::istream::pos_type(-1)) return 0;
  stream_.seekg(0, std::ios::end);
  const std::istream::pos_type end = stream_.tellg();
  stream_.seekg(here);
  return end > here ? static_cast<std::size_t>(end - here) : 0;
}

}  // namespace tanglebin::cloud_format
