// [[source]] of MACHINE.toml (README.md).
#pragma once

#include "schema/base/toml/toml_reader.h"
#include "schema/machine/machine.h"

namespace mdof {

// After the frames. What is wrong is recorded in the table.
void read_sources(TomlTable& root, Machine& machine);

}  // namespace mdof
