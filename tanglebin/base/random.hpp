#pragma once

#include <boost/random/mersenne_twister.hpp>
#include <cstdint>
#include <string_view>

namespace tanglebin {

/// The project's only source of randomness, together with the two functions below. Boost.Random gives the
/// same values on every platform and standard library; the distributions of <random> do not.
using Rng = boost::random::mt19937_64;

/// Seed of one attempt at a case, which determines the whole scene. Changing any argument gives an unrelated
/// seed (FNV-1a over the bytes, finished with SplitMix64).
std::uint64_t attempt_seed(std::uint64_t recipe_seed, std::string_view set, int tubes, int case_id,
                           int attempt);

/// Uniform real number in [low, high), or low if both are equal.
double uniform_real(Rng& rng, double low, double high);

/// Uniform integer in [low, high].
int uniform_integer(Rng& rng, int low, int high);

}  // namespace tanglebin
