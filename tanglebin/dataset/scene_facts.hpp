#pragma once

#include <vector>

#include "tanglebin/files/json_record.hpp"
#include "tanglebin/scan/occlusion.hpp"
#include "tanglebin/settle/contacts.hpp"

// Internal to the library: what hides and touches what, as data.
namespace tanglebin {

/// The JSON object of occlusions/N.json (docs/formats.md).
Json facts_json(const Occlusions& occlusions, const std::vector<Contact>& contacts);

}  // namespace tanglebin
