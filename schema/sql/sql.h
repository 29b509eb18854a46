// The SQL of schema/sql/, embedded at build time; no file is read at run time.
#pragma once

#include <span>

namespace mdof::sql {

// One step of the schema of the database: a file NNN_name.sql. All missing steps are applied in one
// transaction.
struct Migration {
  int version;       // NNN; the value of user_version after this step
  const char* name;  // "001_runs.sql"
  const char* text;
};

std::span<const Migration> migrations();  // ascending: versions 1, 2, 3, ...
const char* recording();                  // schema/recording/recording.sql

}  // namespace mdof::sql
