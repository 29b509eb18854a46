#include "daemon/store/store.h"

#include <sys/stat.h>
#include <unistd.h>

#include "daemon/store/file/migrate.h"
#include "schema/sql/sql.h"

namespace mdof::store {

namespace fs = std::filesystem;
using sqlite::Connection;
using sqlite::OpenMode;

namespace {

int known_version() {
  return sql::migrations().back().version;
}

bool absent_or_empty(const fs::path& file) {
  std::error_code ec;
  return !fs::exists(file, ec) || (fs::is_regular_file(file, ec) && fs::file_size(file, ec) == 0);
}

Status make_parent(const fs::path& file) {
  if (!file.has_parent_path()) return {};
  std::error_code ec;
  fs::create_directories(file.parent_path(), ec);
  std::error_code ignored;  // a folder that cannot be read is treated as missing
  if (ec && !fs::is_directory(file.parent_path(), ignored))
    return io_error(file.parent_path().string() +
                    ": the folder of the database cannot be created: " + ec.message() +
                    "; create this folder, or give another path");
  return {};
}

// Error if the file has a second name (hard link). SQLite derives the name of the journal from the
// name of the file, so SQLite would not find the journal by the second name.
Status check_one_name(const fs::path& file) {
  std::error_code ec;
  const auto names = fs::hard_link_count(file, ec);
  if (ec || names < 2) return {};
  return bad_input(file.string() + ": this database has " + std::to_string(names) +
                   " names (hard links), but the journal of SQLite works with only one of these "
                   "names; remove the other names, or copy the file if you need a copy");
}

// If the database belongs to another user and no mdof program writes it, opens it as a snapshot.
// Otherwise SQLite would create a -shm file in the folder of this user.
OpenMode read_open_mode(const fs::path& file) {
  struct stat now {};
  const bool foreign = ::stat(file.c_str(), &now) == 0 && now.st_uid != ::geteuid();
  return foreign && !WriterLock::held(file) ? OpenMode::snapshot : OpenMode::read_only;
}

Result<Connection> open_reader(const fs::path& file, int busy_timeout_ms) {
  MDOF_TRY(Connection connection, Connection::open(file, read_open_mode(file), busy_timeout_ms));
  MDOF_CHECK(check_kind(connection, known_version()));
  MDOF_CHECK(check_one_name(file));
  return connection;
}

Status check_schema_is_current(Connection& connection) {
  MDOF_TRY(const std::int64_t version, connection.integer("PRAGMA user_version"));
  if (version == known_version()) return {};
  if (version == 0)
    return bad_input(connection.file().string() +
                     ": the database is empty. If it is a copy of a database that mdofd was using, "
                     "the entries of the file -wal are missing; make the copy with: sqlite3 "
                     "DATABASE \".backup 'COPY'\"");
  return bad_input(connection.file().string() + ": has schema version " + std::to_string(version) +
                   ", but this program needs version " + std::to_string(known_version()) +
                   "; to update the database, start mdofd or store a run");
}

Status set_up_writer(Connection& connection, Durability durability) {
  MDOF_CHECK(connection.execute("PRAGMA journal_mode = WAL"));
  MDOF_CHECK(connection.execute(std::string("PRAGMA synchronous = ") + to_string(durability)));
  MDOF_CHECK(connection.execute("PRAGMA foreign_keys = ON"));
  return connection.execute("PRAGMA journal_size_limit = 67108864");
}

Result<Connection> open_writer(const fs::path& file, const StoreOptions& options) {
  MDOF_TRY(Connection connection,
           Connection::open(file, OpenMode::create, options.busy_timeout_ms));
  MDOF_CHECK(check_kind(connection, known_version()));
  MDOF_CHECK(set_up_writer(connection, options.durability));
  MDOF_CHECK(migrate(connection, sql::migrations()));
  return connection;
}

}  // namespace

Result<Store> Store::open(const fs::path& file, Access access, StoreOptions options) {
  if (access == Access::read_only) {
    std::error_code ec;
    if (!fs::exists(file, ec))
      return fail(
          ErrorCode::not_found,
          file.string() + ": no such database; mdof creates it when the first run is stored");
    MDOF_TRY(Connection connection, open_reader(file, options.busy_timeout_ms));
    MDOF_CHECK(check_schema_is_current(connection));
    return Store(WriterLock(), std::move(connection), access);
  }
  MDOF_CHECK(make_parent(file));
  MDOF_TRY(WriterLock lock, WriterLock::acquire(file, options.busy_timeout_ms));
  // The check is before the first write. A file of another program, given by mistake, therefore
  // does not change.
  if (!absent_or_empty(file)) MDOF_CHECK(open_reader(file, options.busy_timeout_ms));
  MDOF_TRY(Connection connection, open_writer(file, options));
  Store store(std::move(lock), std::move(connection), access);
  MDOF_CHECK(store.end_interrupted_runs());
  MDOF_CHECK(store.lock_.claim_open_runs());
  store.connection_.watch_journal();
  return store;
}

}  // namespace mdof::store
