// A thin typed interface to SQLite's C API: a connection with a cache of prepared statements, and a
// transaction that detects when SQLite itself has rolled back. It is in schema/ because the store
// (daemon/) and the reader of recordings (drivers/) use it.
//
// Thread-bound: a connection and all its objects belong to one thread. Errors name the file and the
// operation, and contain SQLite's own text and the remedy.
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
  read_only,   // for a database in use; does not write to the database
  snapshot,    // for any file in its present state; does not write to the file or its folder
  read_write,  // for an existing file
  create,      // as read_write; makes the file if it does not exist
};

// Durability of a commit; see SQLite's "PRAGMA synchronous".
enum class Durability {
  full,  // the data are on the disk before commit returns; a power failure does not affect them
  // The data remain after the end of the process; a power failure may lose the last commits.
  normal,
  off,  // for benchmarks and temporary files
};
const char* to_string(Durability durability);

// The open database and its cache of statements. The address of a Session stays the same when its
// Connection is moved.
struct Session;

// A statement from the cache of its connection; the destructor resets it and returns it to the
// cache. Each call of bind() sets the next parameter, from the left. Text is copied. Bytes are not
// copied and must exist until the last step of the statement. A NaN is stored as NULL; a NULL is
// read as NaN.
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

  Result<bool> step();  // true: there is a row
  Status run();         // executes the statement to its end; it can then be bound again

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

  Status execute(const std::string& sql);  // one or more statements without results
  // The connection keeps the statement in the cache under its text. Only one Statement with the
  // same text may be in use at a time.
  Result<Statement> prepare(std::string_view sql);
  // First column of the first row; 0 if there is no row.
  Result<std::int64_t> integer(std::string_view sql);
  std::int64_t last_insert_rowid() const;
  std::int64_t changes() const;  // number of rows that were written since the connection was opened
  // The last error that reports a damaged file; empty: no such error.
  const std::string& damage() const;

  // After this call, -wal and -shm are watched (journal_watch.h). If other programs would not find
  // the data of a transaction, begin() or commit() returns an error.
  void watch_journal();
  std::string journal_fault();  // reason why writing is impossible; empty: it is possible

  // The last error of SQLite: "FILE: cannot DOING: ... (SQLITE_FULL). Remedy", where DOING is
  // `doing`.
  tl::unexpected<Error> error(std::string_view doing) const;
  const std::filesystem::path& file() const;
  sqlite3* handle() const;

 private:
  friend class Transaction;
  explicit Connection(std::unique_ptr<Session> session);
  std::unique_ptr<Session> session_;
};

// BEGIN IMMEDIATE ... COMMIT. The destructor rolls back if commit() was not called. If the disk is
// full, SQLite itself rolls back, and a second ROLLBACK would be an error; the destructor checks
// this.
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
