#include "tanglebin/base/random.hpp"

#include <boost/random/uniform_int_distribution.hpp>
#include <boost/random/uniform_real_distribution.hpp>

#include "tanglebin/base/counter_random.hpp"

namespace tanglebin {
namespace {

// FNV-1a: http://www.isthe.com/chongo/tech/comp/fnv/
constexpr std::uint64_t fnv_offset = 0xcbf29ce484222325U;
constexpr std::uint64_t fnv_prime = 0x100000001b3U;

void hash_byte(std::uint64_t& hash, unsigned char byte) {
  hash = (hash ^ byte) * fnv_prime;
}

void hash_number(std::uint64_t& hash, std::uint64_t number) {
  for (int shift = 0; shift < 64; shift += 8) hash_byte(hash, static_cast<unsigned char>(number >> shift));
}

}  // namespace

std::uint64_t attempt_seed(std::uint64_t recipe_seed, std::string_view set, int tubes, int case_id,
                           int attempt) {
  std::uint64_t hash = fnv_offset;
  hash_number(hash, recipe_seed);
  hash_number(hash, set.size());
  for (const char c : set) hash_byte(hash, static_cast<unsigned char>(c));
  hash_number(hash, static_cast<std::uint64_t>(tubes));
  hash_number(hash, static_cast<std::uint64_t>(case_id));
  hash_number(hash, static_cast<std::uint64_t>(attempt));
  return mix_bits(hash);
}

double uniform_real(Rng& rng, double low, double high) {
  if (low == high) return low;
  return boost::random::uniform_real_distribution<double>(low, high)(rng);
}

int uniform_integer(Rng& rng, int low, int high) {
  return boost::random::uniform_int_distribution<int>(low, high)(rng);
}

}  // namespace tanglebin
