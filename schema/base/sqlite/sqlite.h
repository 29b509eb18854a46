// Thin typed wrapper of SQLite's C API: a connection with a cache of prepared statements, and a
// transaction that detects when SQLite has rolled back by itself. It is in schema/ because the
// store (daemon/) and the recording reader (drivers/) both use it.
//
// Thread-bound: a connection and all its objects belong to one thread. Errors name the file and the
// operation, contain SQLite's own text, and state the remedy.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "schema/base/result.h"

struct sqlite3;
struct sqlite3_stmt;

namespace mdof::sqlite {

enum class OpenMode {
  read_only,   // for a database in use; does not write to it
  snapshot,    // any file as it is now; does not write to it or beside it
  read_write,  // the file must exist
  create,      // read_write; creates a missing file
};

// Durability of a commit; see SQLite's "PRAGMA synchronous".
enum class Durability {
  full,    // stored on the medium before commit returns: survives a power cut
  normal,  // survives the end of the process; a power cut may lose the last commits
  off,     // for benchmarks and temporary files
};
const char* to_string(Durability durability);

struct Session;  // the open database and its cache of statements; not moved when its owner is moved

// Borrowed from the cache of its connection; the destructor resets and returns it. Parameters are
// bound from the left, one call each. Text is copied; bytes are not copied and must outlive the
// last step of the statement. A NaN is stored as NULL and read back as NaN.
class Statement {
 public:
  Statement(Statement&& other) noexcept;
  Statement& operator=(Statement&&) = delete;
  ~Statement();

  Statement& bind(std::int64_t x);
  Statement& bind(double x);
  Statement& bind(std::string_view text);
  Statement& bind_bytes(std::string_view bytes);
  Statement& bind_null();
  Statement& bind(std::optional<std::int64_t> x) { return x ? bind(*x) : bind_null(); }

  Result<bool> step();  // true: a row is available
  Status run();         // executes to the end; the statement can then be bound again

  std::int64_t integer(int column) const;
  double real(int column) const;
  std::string_view text(int column) const;   // valid until the next step
  std::string_view bytes(int column) const;  // valid until the next step
  bool is_null(int column) const;
  // Type of the stored value: 'n' NULL, 'i' integer, 'd' double, 't' text, 'b' bytes.
  char storage_class(int column) const;
  int columns() const;

 private:
  friend class Connection;
  Statement(Session& session, sqlite3_stmt* statement);
  Session* session_;
  sqlite3_stmt* statement_;
  int next_parameter_ = 1;
};

class Connection {
 public:
  static Result<Connection> open(const std::filesystem::path& file, OpenMode mode,
                                 int busy_timeout_ms = 5000);
  // Reads a database through descriptors (sqlite_descriptors.h); `name` is for messages.
  static Result<Connection> open_descriptors(const std::filesystem::path& name, int database,
                                             int wal);
  Connection(Connection&&) noexcept;
  Connection& operator=(Connection&&) noexcept;
  ~Connection();

  Status execute(const std::string& sql);           // one or more statements without results
  Result<Statement> prepare(std::string_view sql);  // cached by its text; only one user at a time
  Result<std::int64_t> integer(std::string_view sql);  // first column of the first row; none: 0
  std::int64_t last_insert_rowid() const;
  std::int64_t changes() const;       // rows written since the connection was opened
  const std::string& damage() const;  // the last error that reports a damaged file; empty: none

  // From now on -wal and -shm are watched (journal_watch.h): no transaction begins or is
  // acknowledged if the next program would not find it.
  void watch_journal();
  std::string journal_fault();  // why writing is impossible; empty: it is possible

  // The last error as an Error: "FILE: cannot DOING: ... (SQLITE_FULL). Remedy".
  tl::unexpected<Error> error(std::string_view doing) const;
  const std::filesystem::path& file() const;
  sqlite3* handle() const;

 private:
  friend class Transaction;
  explicit Connection(std::unique_ptr<Session> session);
  std::unique_ptr<Session> session_;
};

// BEGIN IMMEDIATE ... COMMIT; rolls back unless committed. If the disk is full, SQLite rolls back
// by itself and a second ROLLBACK would be an error: the destructor checks this first.
class Transaction {
 public:
  static Result<Transaction> begin(Connection& connection);
  Transaction(Transaction&& other) noexcept;
  Transaction& operator=(Transaction&&) = delete;
  ~Transaction();
  Status commit();

 private:
  explicit Transaction(Session& session);
  Session* session_;
};

}  // namespace mdof::sqlite
