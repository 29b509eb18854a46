// The SQL of schema/sql/, embedded at build time; no file is read at run time.
#pragma once

#include <span>

namespace mdof::sql {

// One step of the database's schema: a file NNN_name.sql, applied in one transaction.
struct Migration {
  int version;       // NNN; the value of user_version after this step
  const char* name;  // "001_runs.sql"
  const char* text;
};

std::span<const Migration> migrations();  // ascending: versions 1, 2, 3, ...
const char* recording();                  // schema/recording/recording.sql

}  // namespace mdof::sql
