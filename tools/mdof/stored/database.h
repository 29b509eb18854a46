// Opens the database that a command uses.
#pragma once

#include <filesystem>
#include <string>

#include "daemon/store/store.h"
#include "schema/base/result.h"

namespace mdof::tools {

// `option`: the argument of --db; empty: the default path in daemon/paths.h.
Result<std::filesystem::path> database_path(const std::string& option);
Result<store::Store> open_to_read(const std::string& option);
Result<store::Store> open_to_write(const std::string& option);  // creates a missing database
// For a command that needs stored runs or tables: a missing database is an error.
Result<store::Store> open_existing_to_write(const std::string& option);

// " --db FILE --socket PATH": the options of this command, for the text of the next command. Empty
// for options that were not given.
std::string place_options(const std::string& database, const std::string& socket = "");

// True if mdofd or another mdof has the database open for writing.
Result<bool> is_locked_by_writer(const std::string& option);

}  // namespace mdof::tools
