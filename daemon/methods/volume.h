// The methods compensation.* for volumetric tables. Only files of methods/ include this header.
#pragma once

#include "daemon/methods/methods.h"
#include "schema/base/json_writer.h"

namespace mdof::daemon {

// Largest number of nodes in a page. The limit of bytes can make a page shorter.
inline constexpr std::int64_t kMaxNodesPage = 1000;

// The end of u_covers of compensation.at if the correction is a mean of both approaches.
inline constexpr const char* kReversalLeft =
    "; u does not include the reversal that remains in each approach (reversal_left)";

// Optional parameter of compensation.activate and compensation.deactivate.
std::optional<std::int64_t> expected_generation_param(const rpc::Params& params);
// Whether the parameters contain {"axis": "volume"}.
bool is_volume(const rpc::Params& params);
void deactivate_volume(Methods& m, const rpc::Params& params, rpc::Reply reply);
// Writes null if no volumetric table is active.
void write_volume_status(JsonWriter& json, const Methods& m);
Result<std::string> volume_grid(const Methods& m, const rpc::Params& params);
Result<std::string> volume_at(const Methods& m, const rpc::Params& params);

}  // namespace mdof::daemon
