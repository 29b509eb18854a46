// Reads a SQLite database through open descriptors. No name is looked up, so nobody can substitute
// another file, and nothing is locked or written.
#pragma once

#include <string>

namespace mdof::sqlite {

// Name of the SQLite "VFS" for descriptors; the first call registers it.
const char* descriptors_vfs();

// File name for sqlite3_open_v2() with that VFS. `wal`: descriptor of the -wal beside the database;
// -1: none. Both descriptors remain the caller's and must outlive the connection.
std::string descriptors_name(int database, int wal);

}  // namespace mdof::sqlite
