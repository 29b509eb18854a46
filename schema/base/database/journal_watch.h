// Watches the -wal and -shm files of a database in WAL mode to which this process writes. Another
// program may delete, replace or truncate these files. SQLite does not notice this: it continues to
// write into files that other programs no longer find.
//
// mdof does not use locking_mode = EXCLUSIVE here. With this mode, SQLite would keep the contents
// of -shm in private memory, which cannot be truncated. But readers (mdof runs, show, verify) could
// then not open the database while mdofd has it open.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>

struct sqlite3;

namespace mdof::sqlite {

// Prevents SQLite from opening and deleting super-journals. After a rollback, SQLite would delete
// the file whose name is in the journal, whichever file this is; mdof makes no such journals. Call
// this function before the first database is opened.
void guard_files();

// After this call, a truncated -shm file no longer ends this process by SIGBUS. The mapped regions
// of the file are replaced by memory in which SQLite detects damage (SQLITE_CORRUPT) and finds no
// outdated page. Each JournalWatch then reports a fault. A daemon calls this function before it
// starts its threads.
void survive_truncated_shm();

// Thread-bound: use the object only in the thread of its connection.
class JournalWatch {
 public:
  // The connection must be in WAL mode and must have read from the database before.
  JournalWatch(sqlite3* database, const std::filesystem::path& file);
  // Text of the fault, "FILE-wal was deleted ..."; empty: no change was detected. A fault is
  // permanent. When fault() detects it, it tries to move all committed data into the database,
  // except if the -wal file was truncated. A -wal file of another program is then renamed to
  // FILE-wal.foreign.
  const std::string& fault();
  // Whether the next program finds all committed data: there is no fault, or all data were moved
  // into the database.
  bool is_kept();

 private:
  struct Identity {
    dev_t device = 0;
    ino_t inode = 0;
    bool operator==(const Identity&) const = default;
  };
  static bool identify(const std::filesystem::path& file, Identity& identity, off_t& bytes);
  bool is_cut(off_t wal_bytes);
  void note(std::string what, bool foreign_wal);
  void lose(std::string what);
  void disable_checkpoint_on_close();

  sqlite3* database_;
  std::filesystem::path wal_, shm_;
  Identity wal_identity_, shm_identity_;
  std::string fault_;
  bool moved_ = false;
};

}  // namespace mdof::sqlite
