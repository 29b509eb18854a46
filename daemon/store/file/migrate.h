// Migrates a database to the schema of this program, or rejects it.
#pragma once

#include <span>

#include "schema/base/result.h"
#include "schema/base/sqlite/sqlite.h"
#include "schema/sql/sql.h"

namespace mdof::store {

inline constexpr int kApplication = 0x6d646f66;  // SQLite's application_id: "mdof"

// Accepts an empty database and one of mdof. Error (bad_input): a database of another application,
// or of a newer schema than `known` (the message states both versions). Changes nothing.
Status check_kind(sqlite::Connection& connection, int known);

// Applies the missing migrations, each in one transaction. Before the first one, a database with
// content is copied to "FILE.schema-N.backup".
Status migrate(sqlite::Connection& connection, std::span<const sql::Migration> migrations);

}  // namespace mdof::store
