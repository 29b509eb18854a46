#include "daemon/store/file/migrate.h"

#include <fcntl.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "daemon/store/ledger.h"

namespace mdof::store {

namespace fs = std::filesystem;
using sqlite::Connection;
using sqlite::Statement;
using sqlite::Transaction;

namespace {

void flush_to_disk(const fs::path& file) {
  const int fd = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) return;
  ::fsync(fd);
  ::close(fd);
}

// Writes the backup with a temporary name and then renames it. An incomplete backup therefore never
// has the name of a backup.
Status back_up(Connection& connection, std::int64_t version) {
  const std::string name =
      connection.file().string() + ".schema-" + std::to_string(version) + ".backup";
  const std::string partial = name + ".partial";
  std::error_code ec;
  fs::remove(partial, ec);
  MDOF_TRY(Statement copy, connection.prepare("VACUUM INTO ?"));
  if (const Status copied = copy.bind(std::string_view(partial)).run(); !copied) {
    fs::remove(partial, ec);  // it is useless, and the disk may be full
    return in_context("the backup before the schema change failed, so nothing was changed",
                      copied.error());
  }
  flush_to_disk(partial);
  fs::rename(partial, name, ec);
  if (ec) return io_error(name + ": the backup cannot be renamed to this name: " + ec.message());
  return {};
}

}  // namespace

Status check_kind(Connection& connection, int known) {
  MDOF_TRY(const std::int64_t application, connection.integer("PRAGMA application_id"));
  MDOF_TRY(const std::int64_t tables, connection.integer("SELECT count(*) FROM sqlite_schema"));
  const std::string file = connection.file().string();
  if (application != kApplication && (application != 0 || tables > 0))
    return bad_input(file + ": is an SQLite database of another application (application_id " +
                     std::to_string(application) + "); give a database of mdof");
  MDOF_TRY(const std::int64_t version, connection.integer("PRAGMA user_version"));
  if (version > known)
    return bad_input(file + ": has schema version " + std::to_string(version) +
                     ", but this program supports versions up to " + std::to_string(known) +
                     "; use the newer mdof that wrote this database, or an earlier backup (" +
                     file + ".schema-*.backup)");
  return {};
}

Status migrate(Connection& connection, std::span<const sql::Migration> migrations) {
  MDOF_TRY(const std::int64_t version, connection.integer("PRAGMA user_version"));
  if (migrations.empty() || version >= migrations.back().version) return {};
  if (version > 0) MDOF_CHECK(back_up(connection, version));
  MDOF_TRY(Transaction transaction, Transaction::begin(connection));
  for (const sql::Migration& migration : migrations) {
    if (migration.version <= version) continue;
    if (const Status done = connection.execute(migration.text); !done)
      return in_context(std::string("migration ") + migration.name, done.error());
  }
  const int newest = migrations.back().version;
  // After the last migration, because the hashes contain columns of later migrations.
  if (version < kLedgerSchema && newest >= kLedgerSchema) MDOF_CHECK(link_old_facts(connection));
  MDOF_CHECK(connection.execute("PRAGMA application_id = " + std::to_string(kApplication)));
  MDOF_CHECK(connection.execute("PRAGMA user_version = " + std::to_string(newest)));
  return transaction.commit();
}

}  // namespace mdof::store
