// Allows only one writer for each database. Reason: SQLite before 3.51.3 can damage a WAL database
// if two connections write or make a checkpoint at the same moment. The lock is on the database
// file, so the lock also works if programs open the file by different names or links.
#pragma once

#include <cstdint>
#include <filesystem>

#include "schema/base/result.h"

namespace mdof::store {

class WriterLock {
 public:
  // Waits for the end of another writer, at most `timeout_ms`. Error (conflict): the other writer
  // still holds the lock.
  static Result<WriterLock> acquire(const std::filesystem::path& database, int timeout_ms);
  // Whether any process (also this process) holds the lock.
  static bool held(const std::filesystem::path& database);

  // Call this function after the ends of the runs that a crash interrupted were stored. From then,
  // every open run belongs to this writer.
  Status claim_open_runs();
  static bool open_runs_claimed(const std::filesystem::path& database);

  WriterLock() = default;  // an object without a lock
  WriterLock(WriterLock&& other) noexcept;
  WriterLock& operator=(WriterLock&& other) noexcept;
  ~WriterLock();

 private:
  explicit WriterLock(int fd) : fd_(fd) {}
  static bool held_byte(const std::filesystem::path& database, std::int64_t byte);
  int fd_ = -1;
};

}  // namespace mdof::store
