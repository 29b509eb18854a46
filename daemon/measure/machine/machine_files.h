// Tables in files that MACHINE.toml names (schema/machine/README.md).
#pragma once

#include <functional>
#include <string>

#include "schema/base/result.h"
#include "schema/machine/machine.h"

namespace mdof::daemon {

bool names_files(const Machine& machine);

// What to open for a name as MACHINE.toml has it.
using FindFile = std::function<Result<std::string>(const std::string& name)>;

// Reads them into the machine. Gives a comment line for each, "# x.csv: sha256 …": with it the
// stored description says which numbers were in the file. Errors name file, line, column.
Result<std::string> read_machine_files(Machine& machine, const FindFile& find);

// Those that stand beside MACHINE.toml.
FindFile files_beside(const std::string& machine_file);

}  // namespace mdof::daemon
