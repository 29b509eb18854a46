// The members of every document that state whether a table is active.
#pragma once

#include <cstdint>

#include "schema/base/json_writer.h"

namespace mdof::daemon {

// Members of an open object; `generation` is 0 if the table is not active.
inline void write_active(JsonWriter& json, std::int64_t generation) {
  json.field("active", generation > 0).field("generation", generation);
}

}  // namespace mdof::daemon
