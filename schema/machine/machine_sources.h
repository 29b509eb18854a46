// Reads the tables [[source]] of MACHINE.toml (README.md).
#pragma once

#include "schema/base/toml/toml_reader.h"
#include "schema/machine/machine.h"

namespace mdof {

// Call it after the frames are read. Errors are recorded in the table.
void read_sources(TomlTable& root, Machine& machine);

}  // namespace mdof
