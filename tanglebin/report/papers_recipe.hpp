#pragma once

#include <cstdint>
#include <string>

namespace tanglebin {

/// Whether a dataset's recipe, of this SHA-256 and this seed, is one of the paper's: recipes/paper.toml,
/// set-a.toml or set-b.toml, with any seed.
bool is_papers_recipe(const std::string& recipe_sha256, std::uint64_t seed);

}  // namespace tanglebin
