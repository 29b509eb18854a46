// The chunks of a CSV text, read once for two that go through all of them: the one that parses and
// the one that hashes. Whoever comes first to a chunk reads it, so that both share that work as
// their own leaves them time.
#pragma once

#include <array>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <limits>
#include <mutex>

#include "drivers/csv/line_reader.h"
#include "schema/base/result.h"

namespace mdof::drivers {

class ChunkRing {
 public:
  enum class Role { parser, companion };

  // With `companion` a chunk is kept until that role has done with it too; of a source that may
  // have to wait (a pipe) `parser_reads` is false, and the companion alone reads.
  ChunkRing(ByteSource& source, std::size_t chunk_bytes, bool companion, bool parser_reads);

  // The role's next chunk, which is its own until done(); nullptr: none came within `timeout`, or
  // there is no more, or stop(). Each role is one thread.
  const LineChunk* next(Role role, std::chrono::milliseconds timeout);
  void done(Role role);
  bool ended() const;     // all was read, or could not be; what there is may be still to be taken
  Status status() const;  // why it could not be
  void stop();            // nobody waits any more

 private:
  static constexpr std::size_t kChunks = 6;
  static constexpr std::size_t kNobody = std::numeric_limits<std::size_t>::max();

  std::size_t& done_by(Role role) { return done_[static_cast<std::size_t>(role)]; }
  bool may_read(Role role) const;
  void read_one(std::unique_lock<std::mutex>& lock);

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  LineReader lines_;  // of the role that reads just now
  bool parser_reads_;
  bool reading_ = false, ended_ = false, stopped_ = false;
  Status status_;
  std::array<LineChunk, kChunks> chunks_;
  std::size_t read_ = 0;               // chunks so far
  std::array<std::size_t, 2> done_{};  // by each role
};

}  // namespace mdof::drivers
