// Classifies errors of the database for storing. Private to storekeeper*.cpp.
#pragma once

#include <string>

#include "schema/base/result.h"

namespace mdof::daemon {

// Another program locks the file; this is temporary.
inline bool is_busy(const Error& error) {
  return error.message.find("SQLITE_BUSY") != std::string::npos;
}
template <class T>
bool is_busy(const Result<T>& done) {
  return !done && is_busy(done.error());
}

// The disk accepts no data: it is full, read-only, or fails.
inline bool is_full(const Error& error) {
  for (const char* sign : {"SQLITE_FULL", "SQLITE_READONLY", "SQLITE_IOERR", "SQLITE_CANTOPEN",
                           "No space left", "Read-only file system"})
    if (error.message.find(sign) != std::string::npos) return true;
  return false;
}

}  // namespace mdof::daemon
