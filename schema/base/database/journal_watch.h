// The -wal and -shm files of a database in WAL mode that this process writes, as somebody else may
// delete, replace or cut them: SQLite notices none of that, and goes on to write into files that
// the next program does not find.
//
// -shm stays a file that all programs map, though to keep it in memory (locking_mode = EXCLUSIVE)
// would leave nothing to cut: readers (mdof runs, show, verify) open the database beside mdofd, and
// they could not then.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>

struct sqlite3;

namespace mdof::sqlite {

// Before the first database is opened: SQLite neither opens nor deletes a super-journal from then
// on. Once a rollback is done it would delete the file that the journal names, whatever it is; mdof
// makes no such journals.
void guard_files();

// From now on a -shm file that is cut short does not end this process by SIGBUS. What SQLite has
// mapped of it is replaced by memory in which it finds damage (SQLITE_CORRUPT) and no stale page,
// and each JournalWatch has a fault. For a daemon, before its threads start.
void survive_cut_shm();

// Thread-bound, as the connection.
class JournalWatch {
 public:
  // Of a connection in WAL mode that has read.
  JournalWatch(sqlite3* database, const std::filesystem::path& file);
  // "FILE-wal was deleted ...", for good once it was so; empty: all is as it was. What is in a -wal
  // without a name is moved into the database at once, if that can be.
  const std::string& fault();
  // Whether what was committed is found by the next program: there is no fault, or all was moved.
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
  void leave_files_alone();

  sqlite3* database_;
  std::filesystem::path wal_, shm_;
  Identity wal_identity_, shm_identity_;
  std::string fault_;
  bool moved_ = false;
};

}  // namespace mdof::sqlite
