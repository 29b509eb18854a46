// Brings a database to the schema of this program, or says why it must not be touched.
#pragma once

#include <span>

#include "schema/base/result.h"
#include "schema/base/sqlite/sqlite.h"
#include "schema/sql/sql.h"

namespace mdof::store {

inline constexpr int kApplication = 0x6d646f66;  // SQLite's application_id: "mdof"

// Ok for a database of ours and for an empty one. bad_input: of another application, or of a newer
// schema than `known` (both versions named). Changes nothing.
Status check_kind(sqlite::Connection& connection, int known);

// Applies the migrations that are missing, each in one transaction. Before the first of them a
// database that holds something is copied to "FILE.schema-N.backup".
Status migrate(sqlite::Connection& connection, std::span<const sql::Migration> migrations);

}  // namespace mdof::store
