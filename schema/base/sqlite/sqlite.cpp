#include "schema/base/sqlite/sqlite.h"

#include <sqlite3.h>
#include <unistd.h>

#include <cerrno>
#include <limits>
#include <map>
#include <optional>

#include "schema/base/database/files.h"
#include "schema/base/database/journal_watch.h"

#include "schema/base/sqlite/sqlite_descriptors.h"

namespace mdof::sqlite {

namespace fs = std::filesystem;

struct Session {
  fs::path file;
  sqlite3* database = nullptr;
  std::map<std::string, sqlite3_stmt*, std::less<>> statements;
  std::optional<PrivateCopy> copy;  // the database that is open; `file` is the original file
  std::optional<JournalWatch> watch;
  mutable std::string damage;
  int descriptor = -1;  // the descriptor that open_descriptors() received; otherwise -1

  ~Session() {
    for (const auto& [text, statement] : statements) sqlite3_finalize(statement);
    sqlite3_close(database);
    if (descriptor >= 0) ::close(descriptor);
  }
};

namespace {

struct Advice {
  int code;
  const char* name;
  ErrorCode meaning;
  const char* remedy;
};

constexpr Advice kAdvice[] = {
    {SQLITE_FULL, "SQLITE_FULL", ErrorCode::io,
     "The disk is full: free some space and try again; the data stored before are unchanged."},
    {SQLITE_READONLY, "SQLITE_READONLY", ErrorCode::io,
     "The file or its folder cannot be written: check the owner and mode of both, check that the "
     "file system is not mounted read-only, or choose another folder."},
    {SQLITE_CANTOPEN, "SQLITE_CANTOPEN", ErrorCode::io,
     "Check that the folder exists, and that this user may read and write the folder and the "
     "file."},
    {SQLITE_NOTADB, "SQLITE_NOTADB", ErrorCode::bad_input,
     "This is not a SQLite database: give the right file."},
    {SQLITE_CORRUPT, "SQLITE_CORRUPT", ErrorCode::bad_input,
     "The file is damaged: make a copy of it, then restore the file from a backup or rebuild it "
     "from "
     "the recordings."},
    {SQLITE_IOERR, "SQLITE_IOERR", ErrorCode::io,
     "The disk reported an error: check the health, the free space and the quotas of the disk, and "
     "read the system log."},
    {SQLITE_BUSY, "SQLITE_BUSY", ErrorCode::io,
     "Another program is using the database: try again when that program has finished."},
    {SQLITE_TOOBIG, "SQLITE_TOOBIG", ErrorCode::bad_input, "A value is too large to be stored."},
    {SQLITE_CONSTRAINT, "SQLITE_CONSTRAINT", ErrorCode::bad_input,
     "The database did not store the record, because the record violates a constraint."},
};

tl::unexpected<Error> error_of(const Session& session, std::string_view doing) {
  const int code = sqlite3_errcode(session.database) & 0xff;
  const int extended = sqlite3_extended_errcode(session.database);
  std::string text = session.file.string() + ": cannot " + std::string(doing) + ": " +
                     sqlite3_errmsg(session.database);
  for (const Advice& advice : kAdvice) {
    if (advice.code != code) continue;
    text += " (" + std::string(advice.name) + ", " + std::to_string(extended) + "). ";
    text += advice.remedy;
    if (code == SQLITE_CORRUPT || code == SQLITE_NOTADB) session.damage = text;
    return fail(advice.meaning, text);
  }
  return io_error(text + " (SQLite error " + std::to_string(extended) + ")");
}

// How a database is read. Reading a file of another program must change neither the file nor its
// companion files. If there is a -journal file, SQLite would write, and would delete the file whose
// name is in the journal.
enum class Reading { shared, unchanging, copied };

// A shared reader in WAL mode makes the -shm file if this file does not exist. Therefore `shared`
// is chosen only if the mode and the folder permit a new file, or if another process already shares
// the database. If the -wal file contains no transactions, the database file alone is read
// (`unchanging`).
Reading read_open_mode(const fs::path& file, OpenMode mode) {
  // This process has the file open; the locks of the file must remain.
  if (is_open_for_writing(file)) return Reading::shared;
  if (has_journal(file)) return Reading::copied;
  const bool foreign = mode == OpenMode::snapshot;
  const fs::path folder = beside(file, "").parent_path();
  if (!foreign && access(folder.empty() ? "." : folder.c_str(), W_OK) == 0) return Reading::shared;
  if (!has_wal(file)) return Reading::unchanging;
  return !foreign && is_shared(file) ? Reading::shared : Reading::copied;
}

int open_flags(OpenMode mode) {
  switch (mode) {
    case OpenMode::read_only:
    case OpenMode::snapshot:
      return SQLITE_OPEN_READONLY;
    case OpenMode::read_write:
      return SQLITE_OPEN_READWRITE;
    case OpenMode::create:
      break;
  }
  return SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
}

int rollback(sqlite3* database) {
  return sqlite3_get_autocommit(database)
             ? SQLITE_OK
             : sqlite3_exec(database, "ROLLBACK", nullptr, nullptr, nullptr);
}

}  // namespace

const char* to_string(Durability durability) {
  switch (durability) {
    case Durability::full:
      return "full";
    case Durability::normal:
      return "normal";
    case Durability::off:
      break;
  }
  return "off";
}

// ---- Statement ----

Statement::Statement(Session& session, sqlite3_stmt* statement)
    : session_(&session), statement_(statement) {}

Statement::Statement(Statement&& other) noexcept
    : session_(other.session_),
      statement_(std::exchange(other.statement_, nullptr)),
      next_parameter_(other.next_parameter_) {}

Statement::~Statement() {
  if (!statement_) return;
  sqlite3_reset(statement_);
  sqlite3_clear_bindings(statement_);
}

Statement& Statement::bind(std::int64_t x) {
  sqlite3_bind_int64(statement_, next_parameter_++, x);
  return *this;
}

Statement& Statement::bind(double x) {
  sqlite3_bind_double(statement_, next_parameter_++, x);
  return *this;
}

Statement& Statement::bind(std::string_view text) {
  // With a null pointer, SQLite would store NULL and not an empty text.
  const char* data = text.data() ? text.data() : "";
  sqlite3_bind_text64(statement_, next_parameter_++, data, text.size(), SQLITE_TRANSIENT,
                      SQLITE_UTF8);
  return *this;
}

Statement& Statement::bind_bytes(std::string_view bytes) {
  const char* data = bytes.data() ? bytes.data() : "";
  sqlite3_bind_blob64(statement_, next_parameter_++, data, bytes.size(), SQLITE_STATIC);
  return *this;
}

Statement& Statement::bind_null() {
  sqlite3_bind_null(statement_, next_parameter_++);
  return *this;
}

Result<bool> Statement::step() {
  const int code = sqlite3_step(statement_);
  if (code == SQLITE_ROW) return true;
  if (code == SQLITE_DONE) return false;
  const auto error = error_of(*session_, sqlite3_stmt_readonly(statement_) ? "read" : "write");
  sqlite3_reset(statement_);
  return error;
}

Status Statement::run() {
  for (;;) {
    MDOF_TRY(const bool row, step());
    if (!row) break;
  }
  sqlite3_reset(statement_);
  next_parameter_ = 1;
  return {};
}

std::int64_t Statement::integer(int column) const {
  return sqlite3_column_int64(statement_, column);
}

double Statement::real(int column) const {
  return is_null(column) ? std::numeric_limits<double>::quiet_NaN()
                         : sqlite3_column_double(statement_, column);
}

std::string_view Statement::text(int column) const {
  const auto* data = sqlite3_column_text(statement_, column);
  const auto size = static_cast<std::size_t>(sqlite3_column_bytes(statement_, column));
  return data ? std::string_view(reinterpret_cast<const char*>(data), size) : std::string_view();
}

std::string_view Statement::bytes(int column) const {
  const void* data = sqlite3_column_blob(statement_, column);
  const auto size = static_cast<std::size_t>(sqlite3_column_bytes(statement_, column));
  return data ? std::string_view(static_cast<const char*>(data), size) : std::string_view();
}

bool Statement::is_null(int column) const {
  return sqlite3_column_type(statement_, column) == SQLITE_NULL;
}

char Statement::storage_class(int column) const {
  switch (sqlite3_column_type(statement_, column)) {
    case SQLITE_INTEGER:
      return 'i';
    case SQLITE_FLOAT:
      return 'd';
    case SQLITE_TEXT:
      return 't';
    case SQLITE_BLOB:
      return 'b';
    default:
      return 'n';
  }
}

int Statement::columns() const {
  return sqlite3_column_count(statement_);
}

// ---- Connection ----

Connection::Connection(std::unique_ptr<Session> session) : session_(std::move(session)) {}
Connection::Connection(Connection&&) noexcept = default;
Connection& Connection::operator=(Connection&&) noexcept = default;
Connection::~Connection() = default;

Result<Connection> Connection::open(const fs::path& file, OpenMode mode, int busy_timeout_ms) {
  guard_files();
  MDOF_CHECK(check_journal(file));
  auto session = std::make_unique<Session>();
  session->file = file;
  std::string name = file.string();
  int flags = open_flags(mode) | SQLITE_OPEN_NOMUTEX;
  const bool reads = mode == OpenMode::read_only || mode == OpenMode::snapshot;
  const Reading reading = reads ? read_open_mode(file, mode) : Reading::shared;
  if (reading == Reading::unchanging) {
    session->descriptor = open_foreign(file, 0);
    if (session->descriptor < 0)
      return fail(errno == EINVAL ? ErrorCode::bad_input : ErrorCode::io,
                  file.string() + ": cannot be opened: " + foreign_error_text(errno));
    MDOF_TRY(Connection connection, open_descriptors(file, session->descriptor, -1));
    std::swap(connection.session_->descriptor, session->descriptor);
    return connection;
  }
  if (reading == Reading::copied) {
    MDOF_TRY(PrivateCopy copy, PrivateCopy::make(file, busy_timeout_ms));
    session->copy.emplace(std::move(copy));
    name = session->copy->file().string();
    // Write access is needed to roll back a transaction in the copy, or to read its -wal file.
    flags = SQLITE_OPEN_READWRITE | SQLITE_OPEN_NOMUTEX;
  }
  if (sqlite3_open_v2(name.c_str(), &session->database, flags, nullptr) != SQLITE_OK)
    return error_of(*session, "open");
  sqlite3_extended_result_codes(session->database, 1);
  sqlite3_busy_timeout(session->database, busy_timeout_ms);
  Connection connection(std::move(session));
  if (reading == Reading::copied) MDOF_CHECK(connection.execute("PRAGMA query_only = ON"));
  return connection;
}

Result<Connection> Connection::open_descriptors(const fs::path& name, int database, int wal) {
  auto session = std::make_unique<Session>();
  session->file = name;
  if (sqlite3_open_v2(descriptors_name(database, wal).c_str(), &session->database,
                      SQLITE_OPEN_READONLY | SQLITE_OPEN_NOMUTEX, descriptors_vfs()) != SQLITE_OK)
    return error_of(*session, "open");
  sqlite3_extended_result_codes(session->database, 1);
  Connection connection(std::move(session));
  // Keeps the index of the -wal file and temporary tables in memory.
  MDOF_CHECK(connection.execute("PRAGMA locking_mode = EXCLUSIVE; PRAGMA temp_store = MEMORY"));
  return connection;
}

Status Connection::execute(const std::string& sql) {
  if (sqlite3_exec(session_->database, sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK)
    return error("execute");
  return {};
}

Result<Statement> Connection::prepare(std::string_view sql) {
  auto found = session_->statements.find(sql);
  if (found == session_->statements.end()) {
    sqlite3_stmt* statement = nullptr;
    const int size = static_cast<int>(sql.size());
    if (sqlite3_prepare_v3(session_->database, sql.data(), size, SQLITE_PREPARE_PERSISTENT,
                           &statement, nullptr) != SQLITE_OK)
      return error("read");
    found = session_->statements.emplace(sql, statement).first;
  }
  assert(!sqlite3_stmt_busy(found->second));
  return Statement(*session_, found->second);
}

Result<std::int64_t> Connection::integer(std::string_view sql) {
  MDOF_TRY(Statement statement, prepare(sql));
  MDOF_TRY(const bool row, statement.step());
  return row ? statement.integer(0) : 0;
}

std::int64_t Connection::last_insert_rowid() const {
  return sqlite3_last_insert_rowid(session_->database);
}

std::int64_t Connection::changes() const {
  return sqlite3_total_changes64(session_->database);
}

const std::string& Connection::damage() const {
  return session_->damage;
}

tl::unexpected<Error> Connection::error(std::string_view doing) const {
  return error_of(*session_, doing);
}

void Connection::watch_journal() {
  session_->watch.emplace(session_->database, session_->file);
}

std::string Connection::journal_fault() {
  return session_->watch ? session_->watch->fault() : "";
}

const fs::path& Connection::file() const {
  return session_->file;
}
sqlite3* Connection::handle() const {
  return session_->database;
}

// ---- Transaction ----

Transaction::Transaction(Session& session) : session_(&session) {}

Result<Transaction> Transaction::begin(Connection& connection) {
  if (const std::string fault = connection.journal_fault(); !fault.empty()) return io_error(fault);
  MDOF_CHECK(connection.execute("BEGIN IMMEDIATE"));
  return Transaction(*connection.session_);
}

Transaction::Transaction(Transaction&& other) noexcept
    : session_(std::exchange(other.session_, nullptr)) {}

Transaction::~Transaction() {
  if (session_) rollback(session_->database);
}

Status Transaction::commit() {
  if (sqlite3_exec(session_->database, "COMMIT", nullptr, nullptr, nullptr) != SQLITE_OK) {
    const auto error = error_of(*session_, "commit");
    rollback(session_->database);
    session_ = nullptr;
    return error;
  }
  Session& session = *std::exchange(session_, nullptr);
  // If -wal was deleted, its data are lost when this process ends. Therefore this check is made
  // before the commit is acknowledged.
  if (session.watch && !session.watch->is_kept()) return io_error(session.watch->fault());
  return {};
}

}  // namespace mdof::sqlite
