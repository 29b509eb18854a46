// A SQLite database read through descriptors that are open already: no name is looked up, so that
// nobody can put another file in its place, and nothing is locked or written.
#pragma once

#include <string>

namespace mdof::sqlite {

// The name of SQLite's "VFS" for them; registered by the first call.
const char* descriptors_vfs();

// What sqlite3_open_v2() takes as the name of the file, with that VFS. `wal`: of the -wal beside
// the database; -1: there is none. Both stay the caller's and must outlive the connection.
std::string descriptors_name(int database, int wal);

}  // namespace mdof::sqlite
