// Examines the companion files of a SQLite database (-wal, -shm, -journal) without SQLite, and
// makes a private copy of the database with these files. A database of another program is read
// without writing to it or to its folder.
#pragma once

#include <sys/stat.h>

#include <filesystem>
#include <optional>
#include <string>

#include "schema/base/result.h"

namespace mdof::sqlite {

// Path of a companion file. If `database` is a symbolic link, the companion file is in the folder
// of the link's target. `ending`: "-wal", ...
std::filesystem::path beside(const std::filesystem::path& database, const char* ending);

// Error (bad_input): the rollback journal contains the name of a super-journal (for a transaction
// over several databases). mdof never makes a super-journal. SQLite would delete the file with this
// name.
Status check_journal(const std::filesystem::path& database);

// has_journal(): a transaction must be rolled back before the database is read. has_wal(): the -wal
// file contains transactions.
bool has_journal(const std::filesystem::path& database);
bool has_wal(const std::filesystem::path& database);

// Whether another process has the database open in WAL mode. The function opens the -shm file: do
// not call it for a file for which is_open_for_writing() is true.
bool is_shared(const std::filesystem::path& database);

// Whether this process has the file open for writing, under any name or link: its own database,
// -wal or -shm, or a recording in progress. Files that are open only for appending do not count,
// because SQLite has no lock on them. Do not open a file for which the result is true. When this
// process closes any second descriptor of the file (from open(2) or from a client), the kernel
// removes the locks of SQLite on the file, and another program may delete a -wal file that is in
// use. Only a descriptor with O_PATH removes no locks. To check without a race, get `file` from an
// O_PATH descriptor, and open the file through this descriptor.
bool is_open_for_writing(const struct stat& file);
bool is_open_for_writing(const std::filesystem::path& file);

// Opens the file for reading without waiting. Returns -1 with errno on failure. EBUSY: this process
// writes to the file, so it was not opened; EINVAL: the file is not a regular file. `flags`:
// O_NOFOLLOW or 0.
int open_foreign(const std::filesystem::path& file, int flags);
// Text for the errno of open_foreign().
std::string foreign_error_text(int error);

// A consistent copy of database, -journal and -wal in a folder with mode 0700. The destructor
// removes the folder.
class PrivateCopy {
 public:
  // Waits at most `timeout_ms` for a program that is writing to the file.
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
