// Classifies errors of the database when data are stored. Only storekeeper*.cpp include this
// header.
#pragma once

#include <string>

#include "schema/base/result.h"

namespace mdof::daemon {

// Whether another program locks the file. This error is temporary.
inline bool is_busy(const Error& error) {
  return error.message.find("SQLITE_BUSY") != std::string::npos;
}
template <class T>
bool is_busy(const Result<T>& done) {
  return !done && is_busy(done.error());
}

// Whether the disk accepts no data, because it is full, read-only or faulty.
inline bool is_full(const Error& error) {
  for (const char* sign : {"SQLITE_FULL", "SQLITE_READONLY", "SQLITE_IOERR", "SQLITE_CANTOPEN",
                           "No space left", "Read-only file system"})
    if (error.message.find(sign) != std::string::npos) return true;
  return false;
}

}  // namespace mdof::daemon
