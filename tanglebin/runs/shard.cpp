#include "tanglebin/runs/shard.hpp"

#include <fmt/core.h>

#include <cstdint>
#include <limits>
#include <string_view>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/text.hpp"

namespace tanglebin {
namespace {

constexpr const char* slurm_index = "SLURM_ARRAY_TASK_ID";
constexpr const char* kubernetes_index = "JOB_COMPLETION_INDEX";
constexpr std::string_view remedy = "; --shard I/N says which part to make";

// Wide enough for what is computed from two numbers of the environment.
using Number = std::int64_t;
constexpr Number most = std::numeric_limits<int>::max();

std::optional<Number> number_in(const Environment& environment, const std::string& name) {
  const std::optional<std::string> text = environment(name);
  if (!text) return std::nullopt;
  const auto number = to_number<Number>(*text);
  if (!number || *number < 0 || *number > most) {
    throw InputError({"", 0, name}, excerpt(*text),
                     fmt::format("a whole number from 0 to {}{}", most, remedy));
  }
  return number;
}

Number required_number_in(const Environment& environment, const std::string& name, std::string_view who) {
  const std::optional<Number> number = number_in(environment, name);
  if (!number) throw InputError({"", 0, name}, fmt::format("not set, though {}{}", who, remedy));
  return *number;
}

Shard checked_shard(Number index, Number count, const std::string& variable, Number found) {
  if (index >= 1 && index <= count) return {static_cast<int>(index), static_cast<int>(count)};
  throw InputError({"", 0, variable}, fmt::format("{}", found),
                   fmt::format("one of {} numbers without a gap{}", count, remedy));
}

std::optional<Shard> slurm_shard(const Environment& environment) {
  const std::optional<Number> id = number_in(environment, slurm_index);
  if (!id) return std::nullopt;
  constexpr std::string_view who = "SLURM_ARRAY_TASK_ID is";
  const Number count = required_number_in(environment, "SLURM_ARRAY_TASK_COUNT", who);
  const Number first = required_number_in(environment, "SLURM_ARRAY_TASK_MIN", who);
  const Number step = number_in(environment, "SLURM_ARRAY_TASK_STEP").value_or(1);
  const Number last = first + (count - 1) * step;
  if (const Number found = number_in(environment, "SLURM_ARRAY_TASK_MAX").value_or(last); found != last) {
    throw InputError({"", 0, "SLURM_ARRAY_TASK_MAX"}, fmt::format("{}", found),
                     fmt::format("{}, the last of {} numbers without a gap{}", last, count, remedy));
  }
  const bool is_on_a_step = step > 0 && (*id - first) % step == 0;
  return checked_shard(is_on_a_step ? (*id - first) / step + 1 : 0, count, slurm_index, *id);
}

std::optional<Shard> kubernetes_shard(const Environment& environment) {
  const std::optional<Number> index = number_in(environment, kubernetes_index);
  if (!index) return std::nullopt;
  const Number count = required_number_in(environment, "JOB_COMPLETIONS", "JOB_COMPLETION_INDEX is");
  return checked_shard(*index + 1, count, kubernetes_index, *index);
}

}  // namespace

std::string name_of(const Shard& shard) {
  return fmt::format("{}-of-{}", shard.index, shard.count);
}

std::optional<std::string> array_variable(const Environment& environment) {
  for (const char* name : {slurm_index, kubernetes_index}) {
    if (environment(name)) return name;
  }
  return std::nullopt;
}

std::optional<Shard> shard_from(const Environment& environment) {
  if (const std::optional<Shard> shard = slurm_shard(environment)) return shard;
  return kubernetes_shard(environment);
}

}  // namespace tanglebin
