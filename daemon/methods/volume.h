// The part of compensation.* that is of the volumetric table. Private header of methods/.
#pragma once

#include "daemon/methods/methods.h"
#include "schema/base/json_writer.h"

namespace mdof::daemon {

// As many as a page may have; its bytes may be fewer.
inline constexpr std::int64_t kMaxNodesPage = 1000;

// Of activate and deactivate; nothing: not asked for.
std::optional<std::int64_t> expected_generation_of(const rpc::Params& params);
// {"axis": "volume"}
bool is_volume(const rpc::Params& params);
void deactivate_volume(Methods& m, const rpc::Params& params, rpc::Reply reply);
void write_volume_status(JsonWriter& json, const Methods& m);  // null: none is active
Result<std::string> volume_grid(const Methods& m, const rpc::Params& params);
Result<std::string> volume_at(const Methods& m, const rpc::Params& params);

}  // namespace mdof::daemon
