#include "drivers/csv/chunk_ring.h"

#include <algorithm>

namespace mdof::drivers {

ChunkRing::ChunkRing(ByteSource& source, std::size_t chunk_bytes, bool companion, bool parser_reads)
    : lines_(source, chunk_bytes), parser_reads_(parser_reads) {
  if (!companion) done_by(Role::companion) = kNobody;
}

bool ChunkRing::may_read(Role role) const {
  const bool room = read_ - std::min(done_[0], done_[1]) < kChunks;
  return room && !reading_ && !ended_ && (parser_reads_ || role == Role::companion);
}

// Reads without the lock. This is safe, because the other role does not use lines_ or this chunk at
// that time.
void ChunkRing::read_one(std::unique_lock<std::mutex>& lock) {
  reading_ = true;
  LineChunk& chunk = chunks_[read_ % kChunks];
  lock.unlock();
  Status status = lines_.read(chunk);
  lock.lock();
  reading_ = false;
  ended_ = !status || chunk.text().empty();
  status_ = std::move(status);
  if (!ended_) ++read_;
  changed_.notify_all();
}

const LineChunk* ChunkRing::next(Role role, std::chrono::milliseconds timeout) {
  const auto until = std::chrono::steady_clock::now() + timeout;
  std::unique_lock lock(mutex_);
  const std::size_t wanted = done_by(role);
  while (!stopped_) {
    if (wanted < read_) return &chunks_[wanted % kChunks];
    if (ended_) return nullptr;
    if (may_read(role)) {
      read_one(lock);
    } else if (changed_.wait_until(lock, until) == std::cv_status::timeout) {
      return nullptr;
    }
  }
  return nullptr;
}

void ChunkRing::done(Role role) {
  const std::lock_guard lock(mutex_);
  ++done_by(role);
  changed_.notify_all();
}

bool ChunkRing::ended() const {
  const std::lock_guard lock(mutex_);
  return ended_ && done_[0] == read_;
}

Status ChunkRing::status() const {
  const std::lock_guard lock(mutex_);
  return status_;
}

void ChunkRing::stop() {
  const std::lock_guard lock(mutex_);
  stopped_ = true;
  changed_.notify_all();
}

}  // namespace mdof::drivers
