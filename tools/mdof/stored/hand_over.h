// A ring of N reusable slots between one writing and one reading thread. Nothing is allocated or
// copied on the way; the writer waits for a free slot, so that memory stays bounded.
#pragma once

#include <array>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <mutex>

namespace mdof::tools {

template <class T, std::size_t N>
class HandOver {
 public:
  // Writer: a slot to fill, or nullptr when the reader wants no more. Its old content is there.
  T* begin_write() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return stopped_ || written_ - consumed_ < N; });
    return stopped_ ? nullptr : &slots_[written_ % N];
  }
  void end_write() {
    change([&] { ++written_; });
  }
  // Writer: nothing more will come. What it did before, the reader sees after begin_read().
  void finish() {
    change([&] { finished_ = true; });
  }

  // Reader: the next slot; nullptr when all was read and finished, or after `timeout`.
  template <class Duration>
  T* begin_read(Duration timeout) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, timeout,
                      [&] { return stopped_ || finished_ || written_ != consumed_; });
    return written_ != consumed_ && !stopped_ ? &slots_[consumed_ % N] : nullptr;
  }
  T* begin_read() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return stopped_ || finished_ || written_ != consumed_; });
    return written_ != consumed_ && !stopped_ ? &slots_[consumed_ % N] : nullptr;
  }
  void end_read() {
    change([&] { ++consumed_; });
  }
  // Reader: all was read and nothing will come.
  bool ended() const {
    const std::lock_guard lock(mutex_);
    return finished_ && written_ == consumed_;
  }
  // Either side or a third: both stop waiting.
  void stop() {
    change([&] { stopped_ = true; });
  }

 private:
  template <class Change>
  void change(Change apply) {
    const std::lock_guard lock(mutex_);
    apply();
    changed_.notify_all();
  }

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::array<T, N> slots_;
  std::size_t written_ = 0, consumed_ = 0;
  bool finished_ = false, stopped_ = false;
};

}  // namespace mdof::tools
