// What lies beside a SQLite database (-wal, -shm, -journal), looked at without SQLite, and a
// private copy of all of it: a file of somebody else is read without a byte written to it or beside
// it.
#pragma once

#include <sys/stat.h>

#include <filesystem>
#include <optional>
#include <string>

#include "schema/base/result.h"

namespace mdof::sqlite {

// The database's own companion: beside the file that a link leads to. `ending`: "-wal", ...
std::filesystem::path beside(const std::filesystem::path& database, const char* ending);

// Error (bad_input): the rollback journal names a super-journal (a transaction over several
// databases, which mdof never makes). SQLite would delete the file of that name, whatever it is.
Status check_journal(const std::filesystem::path& database);

// A transaction is to be rolled back, or one to be taken from the -wal file, before anybody reads.
bool has_journal(const std::filesystem::path& database);
bool has_wal(const std::filesystem::path& database);

// Some other process has the database open in WAL mode. Opens -shm: never for a file of which
// is_open_for_writing() is true.
bool is_shared(const std::filesystem::path& database);

// Whether this process has the file open for writing, by whatever name or link: its own database,
// -wal or -shm, or a recording under way. One that is open for appending alone counts for nothing,
// as SQLite has no lock by it. To close any other descriptor of such a file (also one of
// open(2), or one that a client passed) drops the locks that SQLite has on it, and another program
// may then delete a -wal that is in use. Ask before the file is opened; a descriptor of open(2)
// with O_PATH drops nothing and answers the question without a race.
bool is_open_for_writing(const struct stat& file);
bool is_open_for_writing(const std::filesystem::path& file);

// A descriptor for reading of what the name means at this moment, never waiting; -1 and errno:
// EBUSY: this process writes the file, and it was not opened; EINVAL: it is no regular file.
// `flags`: O_NOFOLLOW, or 0.
int open_foreign(const std::filesystem::path& file, int flags);
// What is to be said of its errno.
std::string foreign_error_text(int error);

// Database, -journal and -wal as they are at one moment, in a folder of mode 0700 that is removed
// with the copy.
class PrivateCopy {
 public:
  // Waits up to `timeout_ms` for a program that writes the file at this moment.
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
