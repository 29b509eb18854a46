// Whether a table is active, as every document says it.
#pragma once

#include <cstdint>

#include "schema/base/json_writer.h"

namespace mdof::daemon {

// Members of an open object; `generation` 0: it is not active.
inline void write_active(JsonWriter& json, std::int64_t generation) {
  json.field("active", generation > 0).field("generation", generation);
}

}  // namespace mdof::daemon
