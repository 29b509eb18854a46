// One writer a database: SQLite before 3.51.3 can damage a WAL database when two connections write
// or checkpoint at the same moment, so a second one is never opened. The lock is on the database
// itself, whatever name or link it was opened by.
#pragma once

#include <cstdint>
#include <filesystem>

#include "schema/base/result.h"

namespace mdof::store {

class WriterLock {
 public:
  // Waits up to `timeout_ms` for another writer to end; then `conflict`.
  static Result<WriterLock> acquire(const std::filesystem::path& database, int timeout_ms);
  // Whether some process, or another lock of this one, holds it.
  static bool held(const std::filesystem::path& database);

  // From now on runs without an end are this writer's; before that those that a kill has cut off.
  Status claim_open_runs();
  static bool open_runs_claimed(const std::filesystem::path& database);

  WriterLock() = default;  // holds nothing
  WriterLock(WriterLock&& other) noexcept;
  WriterLock& operator=(WriterLock&& other) noexcept;
  ~WriterLock();

 private:
  explicit WriterLock(int fd) : fd_(fd) {}
  static bool held_byte(const std::filesystem::path& database, std::int64_t byte);
  int fd_ = -1;
};

}  // namespace mdof::store
