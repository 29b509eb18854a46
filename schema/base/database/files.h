// Files beside a SQLite database (-wal, -shm, -journal), examined without SQLite, and a private
// copy of all of them. A foreign database is read without writing to it or beside it.
#pragma once

#include <sys/stat.h>

#include <filesystem>
#include <optional>
#include <string>

#include "schema/base/result.h"

namespace mdof::sqlite {

// Path of a companion file of the database: beside the target of a symbolic link. `ending`: "-wal",
// ...
std::filesystem::path beside(const std::filesystem::path& database, const char* ending);

// Error (bad_input): the rollback journal names a super-journal (a transaction over several
// databases, which mdof never makes). SQLite would delete the file of that name.
Status check_journal(const std::filesystem::path& database);

// has_journal(): a transaction must be rolled back before reading. has_wal(): the -wal file
// contains transactions.
bool has_journal(const std::filesystem::path& database);
bool has_wal(const std::filesystem::path& database);

// Whether another process has the database open in WAL mode. Opens -shm: do not call it for a file
// for which is_open_for_writing() is true.
bool is_shared(const std::filesystem::path& database);

// Whether this process has the file open for writing, by any name or link: its own database, -wal
// or -shm, or a recording in progress. Files open only for appending do not count, because SQLite
// has no lock on them. Closing any other descriptor of such a file (also one of open(2), or one
// that a client passed) drops the locks of SQLite on it, and another program may then delete a -wal
// that is in use. Ask before opening the file; a descriptor of open(2) with O_PATH drops no locks
// and answers the question without a race.
bool is_open_for_writing(const struct stat& file);
bool is_open_for_writing(const std::filesystem::path& file);

// Opens the file for reading without waiting. -1 and errno: EBUSY: this process writes the file,
// which was not opened; EINVAL: not a regular file. `flags`: O_NOFOLLOW or 0.
int open_foreign(const std::filesystem::path& file, int flags);
// Text for the errno of open_foreign().
std::string foreign_error_text(int error);

// A consistent copy of database, -journal and -wal in a folder of mode 0700. The folder is removed
// with the object.
class PrivateCopy {
 public:
  // Waits up to `timeout_ms` for a program that is writing the file.
  static Result<PrivateCopy> make(const std::filesystem::path& database, int timeout_ms);
  PrivateCopy(PrivateCopy&& other) noexcept;
  PrivateCopy& operator=(PrivateCopy&&) = delete;
  ~PrivateCopy();
  std::filesystem::path file() const { return folder_ / "copy"; }

 private:
  explicit PrivateCopy(std::filesystem::path folder) : folder_(std::move(folder)) {}
  std::filesystem::path folder_;
};

}  // namespace mdof::sqlite
