// JSON of volumetric tables: the same for the command line and the RPC.
#pragma once

#include "schema/base/json_writer.h"
#include "schema/volumetric/volumetric_table.h"

namespace mdof {

// Writes the members that hold for the whole table into an open object.
void write_volumetric_members(JsonWriter& json, const VolumetricTable& table);
// Writes "rotary": {"C_deg": ...}, the positions of the rotary axes, into an open object.
void write_rotary(JsonWriter& json, const VolumetricTable& table);
// Writes {"X_um": ..., "Y_um": ..., "Z_um": ...} under a key of an open object.
void write_um(JsonWriter& json, const char* key, const Vec3& value_m);
// One node: [X_mm, Y_mm, Z_mm, three corrections in um, three u in um]; with parts also three
// u_common and three u_independent.
void write_volumetric_node(JsonWriter& json, const VolumetricTable& table, std::size_t node,
                           bool with_parts);

}  // namespace mdof
