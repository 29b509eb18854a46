// Permits one writer per database: SQLite before 3.51.3 can damage a WAL database if two
// connections write or checkpoint at the same moment. The lock is on the database itself,
// independent of the name or link that opened it.
#pragma once

#include <cstdint>
#include <filesystem>

#include "schema/base/result.h"

namespace mdof::store {

class WriterLock {
 public:
  // Waits up to `timeout_ms` for the end of another writer; then Error `conflict`.
  static Result<WriterLock> acquire(const std::filesystem::path& database, int timeout_ms);
  // Whether any process, or another lock of this one, holds the lock.
  static bool held(const std::filesystem::path& database);

  // After this call, open runs belong to this writer; before it, they are runs that a crash
  // interrupted.
  Status claim_open_runs();
  static bool open_runs_claimed(const std::filesystem::path& database);

  WriterLock() = default;  // holds no lock
  WriterLock(WriterLock&& other) noexcept;
  WriterLock& operator=(WriterLock&& other) noexcept;
  ~WriterLock();

 private:
  explicit WriterLock(int fd) : fd_(fd) {}
  static bool held_byte(const std::filesystem::path& database, std::int64_t byte);
  int fd_ = -1;
};

}  // namespace mdof::store
