#pragma once

#include <boost/random/mersenne_twister.hpp>
#include <cstdint>
#include <string_view>

namespace tanglebin {

/// All randomness comes from this generator and the two draws below: Boost.Random's values are the same on
/// every platform and standard library, those of <random>'s distributions are not.
using Rng = boost::random::mt19937_64;

/// Seed of one attempt at one case: everything that a scene consists of follows from it. Any change of an
/// argument gives an unrelated seed (FNV-1a over the bytes, finished with SplitMix64).
std::uint64_t attempt_seed(std::uint64_t recipe_seed, std::string_view set, int tubes, int case_id,
                           int attempt);

/// Uniform real number in [low, high); low where both are equal.
double uniform_real(Rng& rng, double low, double high);

/// Uniform integer in [low, high].
int uniform_integer(Rng& rng, int low, int high);

}  // namespace tanglebin
