// The methods compensation.* for volumetric tables. Private header of methods/.
#pragma once

#include "daemon/methods/methods.h"
#include "schema/base/json_writer.h"

namespace mdof::daemon {

// Maximum number of nodes in a page; the limit of bytes may allow fewer.
inline constexpr std::int64_t kMaxNodesPage = 1000;

// Parameter of activate and deactivate; nullopt if not given.
std::optional<std::int64_t> expected_generation_param(const rpc::Params& params);
// {"axis": "volume"}
bool is_volume(const rpc::Params& params);
void deactivate_volume(Methods& m, const rpc::Params& params, rpc::Reply reply);
void write_volume_status(JsonWriter& json, const Methods& m);  // null: none is active
Result<std::string> volume_grid(const Methods& m, const rpc::Params& params);
Result<std::string> volume_at(const Methods& m, const rpc::Params& params);

}  // namespace mdof::daemon
