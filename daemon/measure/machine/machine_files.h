// Reads the table files that MACHINE.toml names (schema/machine/README.md).
#pragma once

#include <functional>
#include <string>

#include "schema/base/result.h"
#include "schema/machine/machine.h"

namespace mdof::daemon {

bool has_table_files(const Machine& machine);

// The path to open for a file name in MACHINE.toml.
using FindFile = std::function<Result<std::string>(const std::string& name)>;

// Reads the files into the machine. Returns a comment line with the hash of each file, "# x.csv:
// sha256 …". The stored description of the machine contains these lines. Errors state file, line
// and column.
Result<std::string> read_machine_files(Machine& machine, const FindFile& find);

// Finds files in the folder of MACHINE.toml.
FindFile files_in_same_folder(const std::string& machine_file);

}  // namespace mdof::daemon
