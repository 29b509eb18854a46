// The JSON of volumetric tables: one form for the command line and the RPC.
#pragma once

#include "schema/base/json_writer.h"
#include "schema/volumetric/volumetric_table.h"

namespace mdof {

// What holds for the whole table; the members of an open object.
void write_volumetric_members(JsonWriter& json, const VolumetricTable& table);
// "rotary": {"C_deg": ...}, where the rotary axes stand; a member of an open object.
void write_rotary(JsonWriter& json, const VolumetricTable& table);
// {"X_um": ..., "Y_um": ..., "Z_um": ...} under a key of an open object.
void write_um(JsonWriter& json, const char* key, const Vec3& value_m);
// One node: [X_mm, Y_mm, Z_mm, three corrections in um, three u in um]; with parts three u_common
// and three u_independent behind them.
void write_volumetric_node(JsonWriter& json, const VolumetricTable& table, std::size_t node,
                           bool with_parts);

}  // namespace mdof
