// Keys of a rig outside [[probe]] and [[plane]], for parse_rig(). Errors are recorded in the table.
#pragma once

#include "schema/axis.h"
#include "schema/base/toml/toml_reader.h"
#include "schema/rig/rig.h"

namespace mdof {

// Reads the key delay_us; returns s, 0 if the key is missing. Rejects a delay that is negative or
// longer than 10 s; `meaning` completes the message.
double read_delay_s(TomlTable& table, const char* meaning);

// A point in mm, at most 2 m from the origin along each axis; returned in m.
Vec3 read_point(TomlTable& table, const char* key);
void read_encoder(TomlTable& table, Rig& rig);
void read_installation_and_drift(TomlTable& table, Rig& rig);
void read_artefact(TomlTable& table, Rig& rig);

}  // namespace mdof
