// JSON of volumetric tables. The command line and the RPC use the same JSON.
#pragma once

#include "schema/base/json_writer.h"
#include "schema/volumetric/volumetric_table.h"

namespace mdof {

// Writes the members that apply to the whole table into an open object.
void write_volumetric_members(JsonWriter& json, const VolumetricTable& table);
// Writes the positions of the rotary axes, "rotary": {"C_deg": ...}, into an open object.
void write_rotary(JsonWriter& json, const VolumetricTable& table);
// Writes {"X_um": ..., "Y_um": ..., "Z_um": ...} as the value of `key` into an open object.
void write_um(JsonWriter& json, const char* key, const Vec3& value_m);
// Writes one node: [X_mm, Y_mm, Z_mm, three corrections in µm, three u in µm]. If `with_parts`,
// three u_common and three u_independent follow.
void write_volumetric_node(JsonWriter& json, const VolumetricTable& table, std::size_t node,
                           bool with_parts);

}  // namespace mdof
