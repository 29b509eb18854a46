// The chunks of a CSV text, read once for two threads that both go through all of them: one parses,
// one hashes. The thread that needs a chunk first reads it, so the two share the reading according
// to their load.
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

  // With `companion`, a chunk is kept until that role has finished with it too. `parser_reads` is
  // false for a source that may block (a pipe); then only the companion reads.
  ChunkRing(ByteSource& source, std::size_t chunk_bytes, bool companion, bool parser_reads);

  // The role's next chunk, valid until done(). nullptr: no chunk within `timeout`, no more chunks,
  // or stop() was called. Each role is one thread.
  const LineChunk* next(Role role, std::chrono::milliseconds timeout);
  void done(Role role);
  bool ended() const;     // all was read or reading failed, and the parser has taken all chunks
  Status status() const;  // why reading failed
  void stop();            // ends all waiting

 private:
  static constexpr std::size_t kChunks = 6;
  static constexpr std::size_t kNobody = std::numeric_limits<std::size_t>::max();

  std::size_t& done_by(Role role) { return done_[static_cast<std::size_t>(role)]; }
  bool may_read(Role role) const;
  void read_one(std::unique_lock<std::mutex>& lock);

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  LineReader lines_;  // used only by the role that reads now
  bool parser_reads_;
  bool reading_ = false, ended_ = false, stopped_ = false;
  Status status_;
  std::array<LineChunk, kChunks> chunks_;
  std::size_t read_ = 0;               // number of chunks read
  std::array<std::size_t, 2> done_{};  // number of chunks finished, by role
};

}  // namespace mdof::drivers
