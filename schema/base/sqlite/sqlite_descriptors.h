// Reads a SQLite database through open file descriptors. No file name is used, so that nobody can
// substitute another file. Nothing is locked and nothing is written.
#pragma once

#include <string>

namespace mdof::sqlite {

// Name of the VFS of SQLite that reads from descriptors. The first call registers it.
const char* descriptors_vfs();

// File name for sqlite3_open_v2() with this VFS. `wal`: descriptor of the -wal file of the
// database; -1: no such file. The caller owns both descriptors; they must exist longer than the
// connection.
std::string descriptors_name(int database, int wal);

}  // namespace mdof::sqlite
