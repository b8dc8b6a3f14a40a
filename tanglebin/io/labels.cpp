#include "tanglebin/io/labels.hpp"

#include <fmt/core.h>

#include <fstream>
#include <istream>
#include <limits>
#include <optional>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/text.hpp"
#include "tanglebin/files/read_file.hpp"
#include "tanglebin/geometry/labels.hpp"
#include "tanglebin/io/npy.hpp"
#include "tanglebin/io/read_cloud.hpp"

namespace tanglebin {
namespace {

using cloud_format::CloudInput;

constexpr const char* a_label = "a label: an integer from -1 to 2147483647";

bool is_label(std::int64_t number) {
  return number >= null_label && number <= std::numeric_limits<std::int32_t>::max();
}

std::vector<std::int32_t> read_array(CloudInput& input) {
  const std::vector<std::int64_t> numbers = read_npy_integers(input);
  std::vector<std::int32_t> labels;
  labels.reserve(numbers.size());
  for (const std::int64_t number : numbers) {
    if (!is_label(number))
      throw InputError(input.place_in_file(fmt::format("label {}", labels.size() + 1)),
                       fmt::format("{}", number), a_label);
    labels.push_back(static_cast<std::int32_t>(number));
  }
  return labels;
}

std::vector<std::int32_t> read_text(CloudInput& input) {
  std::vector<std::int32_t> labels;
  while (const std::optional<std::string_view> line = input.next_line()) {
    const std::vector<std::string_view> words = words_of(*line);
    const auto number = words.size() == 1 ? to_number<std::int64_t>(words.front()) : std::nullopt;
    if (!number || !is_label(*number)) throw InputError(input.place(), excerpt(*line), a_label);
    labels.push_back(static_cast<std::int32_t>(*number));
  }
  return labels;
}

}  // namespace

GivenLabels read_labels(std::istream& in, const std::string& name) {
  const char first = std::istream::traits_type::to_char_type(in.peek());
  if (first == 'p' || first == '#' || first == 'V') return read_cloud(in, name);
  CloudInput input(in, name);
  if (first == '\x93') return read_array(input);
  return read_text(input);
}

GivenLabels read_labels(const std::filesystem::path& file) {
  std::optional<std::ifstream> in = open_if_there(file);
  if (!in) throw InputError({file.string(), 0, ""}, "is missing");
  GivenLabels labels = read_labels(*in, file.string());
  expect_read(*in, file);
  return labels;
}

}  // namespace tanglebin
