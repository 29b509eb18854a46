#include "schema/base/sqlite/sqlite_descriptors.h"

#include <sqlite3.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <string_view>

namespace mdof::sqlite {
namespace {

struct OpenFile {
  sqlite3_file base;  // must be the first member: SQLite converts pointers between the two types
  int descriptor;     // -1: an empty file
};

int descriptor_of(sqlite3_file* file) {
  return reinterpret_cast<OpenFile*>(file)->descriptor;
}

int close_file(sqlite3_file*) {
  return SQLITE_OK;
}

// Bytes after the end of the file are read as zeros.
int read_file(sqlite3_file* file, void* to, int count, sqlite3_int64 offset) {
  auto* const bytes = static_cast<char*>(to);
  const auto wanted = static_cast<std::size_t>(std::max(count, 0));
  std::size_t done = 0;
  while (done < wanted && descriptor_of(file) >= 0) {
    const ssize_t got = ::pread(descriptor_of(file), bytes + done, wanted - done,
                                offset + static_cast<sqlite3_int64>(done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return SQLITE_IOERR_READ;
    if (got == 0) break;
    done += static_cast<std::size_t>(got);
  }
  std::fill(bytes + done, bytes + wanted, '\0');
  return done < wanted ? SQLITE_IOERR_SHORT_READ : SQLITE_OK;
}

int size_of_file(sqlite3_file* file, sqlite3_int64* size) {
  struct stat now {};
  const bool known = descriptor_of(file) >= 0 && ::fstat(descriptor_of(file), &now) == 0;
  *size = known ? now.st_size : 0;
  return SQLITE_OK;
}

int refuse_write(sqlite3_file*, const void*, int, sqlite3_int64) {
  return SQLITE_READONLY;
}
int refuse_truncate(sqlite3_file*, sqlite3_int64) {
  return SQLITE_READONLY;
}
int nothing(sqlite3_file*, int) {
  return SQLITE_OK;
}
int nobody_else_writes(sqlite3_file*, int* reserved) {
  *reserved = 0;
  return SQLITE_OK;
}
int no_control(sqlite3_file*, int, void*) {
  return SQLITE_NOTFOUND;
}
int zero(sqlite3_file*) {
  return 0;
}

const sqlite3_io_methods kMethods = [] {
  sqlite3_io_methods m{};
  m.iVersion = 1;  // version 1 has no shared memory
  m.xClose = close_file;
  m.xRead = read_file;
  m.xWrite = refuse_write;
  m.xTruncate = refuse_truncate;
  m.xSync = nothing;
  m.xFileSize = size_of_file;
  m.xLock = nothing;
  m.xUnlock = nothing;
  m.xCheckReservedLock = nobody_else_writes;
  m.xFileControl = no_control;
  m.xSectorSize = zero;
  m.xDeviceCharacteristics = zero;
  return m;
}();

// Parses "DATABASE,WAL". The text may end in "-wal".
struct Named {
  int database = -1, wal = -1;
};
Named named(const char* name) {
  Named found;
  if (std::sscanf(name, "%d,%d", &found.database, &found.wal) != 2) return {};
  return found;
}

int open_file(sqlite3_vfs*, const char* name, sqlite3_file* file, int flags, int* out_flags) {
  file->pMethods = nullptr;
  if (!name || !(flags & (SQLITE_OPEN_MAIN_DB | SQLITE_OPEN_WAL))) return SQLITE_CANTOPEN;
  const Named from = named(name);
  auto* opened = reinterpret_cast<OpenFile*>(file);
  opened->descriptor = flags & SQLITE_OPEN_WAL ? from.wal : from.database;
  opened->base.pMethods = &kMethods;
  if (out_flags) *out_flags = (flags & ~SQLITE_OPEN_READWRITE) | SQLITE_OPEN_READONLY;
  return SQLITE_OK;
}

int refuse_delete(sqlite3_vfs*, const char*, int) {
  return SQLITE_READONLY;
}

int is_there(sqlite3_vfs*, const char* name, int, int* there) {
  *there = std::string_view(name).ends_with("-wal") && named(name).wal >= 0 ? 1 : 0;
  return SQLITE_OK;
}

int as_it_is(sqlite3_vfs*, const char* name, int size, char* out) {
  sqlite3_snprintf(size, out, "%s", name);
  return SQLITE_OK;
}

}  // namespace

const char* descriptors_vfs() {
  static const char* const name = [] {
    // The clock and the random numbers of this VFS are used.
    static sqlite3_vfs vfs = *sqlite3_vfs_find("unix");
    vfs.zName = "mdof-descriptors";
    vfs.szOsFile = sizeof(OpenFile);
    vfs.pNext = nullptr;
    vfs.xOpen = open_file;
    vfs.xDelete = refuse_delete;
    vfs.xAccess = is_there;
    vfs.xFullPathname = as_it_is;
    sqlite3_vfs_register(&vfs, 0);
    return vfs.zName;
  }();
  return name;
}

std::string descriptors_name(int database, int wal) {
  return std::to_string(database) + "," + std::to_string(wal);
}

}  // namespace mdof::sqlite
