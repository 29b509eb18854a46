// Watches the -wal and -shm files of a database in WAL mode that this process writes. Another
// program may delete, replace or truncate them. SQLite does not notice this and continues to write
// into files that the next program does not find.
//
// -shm remains a file that all programs map. To keep it in memory (locking_mode = EXCLUSIVE) would
// avoid truncation, but readers (mdof runs, show, verify) could then not open the database while
// mdofd has it open.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>

struct sqlite3;

namespace mdof::sqlite {

// Prevents SQLite from opening and deleting super-journals. After a rollback SQLite would delete
// the file that the journal names, whatever it is; mdof makes no such journals. Call it before the
// first database is opened.
void guard_files();

// From now on a truncated -shm file does not end this process by SIGBUS. Its mapped regions are
// replaced by memory in which SQLite detects damage (SQLITE_CORRUPT) and finds no outdated page,
// and each JournalWatch reports a fault. For a daemon, before its threads start.
void survive_truncated_shm();

// Thread-bound, as the connection is.
class JournalWatch {
 public:
  // For a connection in WAL mode that has already read.
  JournalWatch(sqlite3* database, const std::filesystem::path& file);
  // "FILE-wal was deleted ..."; empty: no change detected. A fault is permanent. After a fault
  // other than a truncated -wal, committed data are moved into the database immediately, if
  // possible.
  const std::string& fault();
  // Whether the next program finds all committed data: no fault, or all data were moved.
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
