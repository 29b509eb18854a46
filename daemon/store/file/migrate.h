// Checks a database, and migrates it to the schema of this program.
#pragma once

#include <span>

#include "schema/base/result.h"
#include "schema/base/sqlite/sqlite.h"
#include "schema/sql/sql.h"

namespace mdof::store {

inline constexpr int kApplication = 0x6d646f66;  // application_id of SQLite: the bytes of "mdof"

// Checks the database and does not change it. An empty database and a database of mdof are
// accepted. Error (bad_input): the database belongs to another application, or the schema of the
// database is newer than `known`. The message states both versions.
Status check_kind(sqlite::Connection& connection, int known);

// Applies the missing migrations in one transaction. Before that, a database that is not empty is
// copied to "FILE.schema-N.backup".
Status migrate(sqlite::Connection& connection, std::span<const sql::Migration> migrations);

}  // namespace mdof::store
