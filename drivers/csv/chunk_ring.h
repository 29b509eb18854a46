// The chunks of a CSV text for two threads: one thread parses all chunks, the other thread hashes
// all chunks. Each chunk is read from the file only once, by the thread that needs the chunk first.
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

  // `companion`: true if the second thread exists; a chunk is then kept until both threads have
  // finished with it. `parser_reads`: false for a source that may block (a pipe); then only the
  // companion reads.
  ChunkRing(ByteSource& source, std::size_t chunk_bytes, bool companion, bool parser_reads);

  // Returns the next chunk for this role, valid until done(). nullptr: no chunk arrived within
  // `timeout`, no chunks remain, or stop() was called. Each role belongs to one thread.
  const LineChunk* next(Role role, std::chrono::milliseconds timeout);
  void done(Role role);
  // True: the source has ended or failed, and the parser has finished all chunks.
  bool ended() const;
  Status status() const;  // error of the source
  void stop();            // wakes all waiting threads

 private:
  static constexpr std::size_t kChunks = 6;
  static constexpr std::size_t kNobody = std::numeric_limits<std::size_t>::max();

  std::size_t& done_by(Role role) { return done_[static_cast<std::size_t>(role)]; }
  bool may_read(Role role) const;
  void read_one(std::unique_lock<std::mutex>& lock);

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  LineReader lines_;  // used only by the thread that reads now
  bool parser_reads_;
  bool reading_ = false, ended_ = false, stopped_ = false;
  Status status_;
  std::array<LineChunk, kChunks> chunks_;
  std::size_t read_ = 0;               // number of chunks that were read
  std::array<std::size_t, 2> done_{};  // number of finished chunks, for each role
};

}  // namespace mdof::drivers
