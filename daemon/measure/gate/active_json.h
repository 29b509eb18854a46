// Writes the members that state whether a table is active. All documents of tables use this
// function.
#pragma once

#include <cstdint>

#include "schema/base/json_writer.h"

namespace mdof::daemon {

// Adds the members to an open object. `generation`: 0 if the table is not active.
inline void write_active(JsonWriter& json, std::int64_t generation) {
  json.field("active", generation > 0).field("generation", generation);
}

}  // namespace mdof::daemon
