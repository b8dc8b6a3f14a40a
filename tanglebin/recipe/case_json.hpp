#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "tanglebin/files/json_record.hpp"
#include "tanglebin/recipe/case_id.hpp"

// Internal to the library: how the JSON lines of datasets and results name their case.
namespace tanglebin {

/// The members by which every line says which case it is about. They come first.
Json id_json(const CaseId& id);

/// The case that a line of JSON begins with. The rest of the line is not read: a manifest may have a hundred
/// thousand of them. Throws InputError.
CaseId id_of_line(std::string_view line, const std::string& file, std::size_t number);

/// The case that a record of a whole line names. Throws InputError.
CaseId id_of(const JsonRecord& record);

}  // namespace tanglebin
