// A queue with a limited number of items, between two threads. try_push() rejects and counts items
// if the queue is full; push() and push_for() wait until the queue has room.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <utility>

namespace mdof {

// Thread-safe.
template <class T>
class BoundedQueue {
 public:
  explicit BoundedQueue(std::size_t capacity) : capacity_(capacity) {}

  // Returns false if the queue is full or closed; the item is then counted as dropped.
  bool try_push(T value) {
    const std::lock_guard lock(mutex_);
    if (closed_ || items_.size() >= capacity_) {
      ++dropped_;
      return false;
    }
    items_.push_back(std::move(value));
    filled_.notify_one();
    return true;
  }

  enum class Wake { yes, no };  // no: a waiting thread may sleep until its time-out
  // Waits for room, at most `timeout`. Returns false and leaves `value` unchanged if there is no
  // room or the queue is closed.
  bool push_for(T& value, std::chrono::milliseconds timeout, Wake wake = Wake::yes) {
    std::unique_lock lock(mutex_);
    emptied_.wait_for(lock, timeout, [&] { return closed_ || items_.size() < capacity_; });
    if (closed_ || items_.size() >= capacity_) return false;
    items_.push_back(std::move(value));
    lock.unlock();  // before the wake-up, so that the other thread finds the mutex free
    if (wake == Wake::yes) filled_.notify_one();
    return true;
  }

  // Waits for room. Returns false if the queue is closed.
  bool push(T value) {
    std::unique_lock lock(mutex_);
    emptied_.wait(lock, [&] { return closed_ || items_.size() < capacity_; });
    if (closed_) return false;
    items_.push_back(std::move(value));
    filled_.notify_one();
    return true;
  }

  // Adds the item even if the queue is full. Use it only for commands that must not wait.
  void push_always(T value) {
    const std::lock_guard lock(mutex_);
    if (closed_) return;
    items_.push_back(std::move(value));
    filled_.notify_one();
  }

  // Returns the oldest item; nullopt: no item arrived before the time-out, or the queue is closed
  // and empty.
  std::optional<T> pop(std::chrono::milliseconds timeout) {
    std::unique_lock lock(mutex_);
    filled_.wait_for(lock, timeout, [&] { return closed_ || !items_.empty(); });
    return take_front();
  }

  // Moves all items into `taken`, the oldest first. `taken` is empty if no item arrived before the
  // time-out, or if the queue is closed and empty. The previous contents of `taken` are deleted,
  // and their memory is reused. The items in `taken` no longer count for the capacity of the queue.
  void pop_all(std::deque<T>& taken, std::chrono::milliseconds timeout) {
    taken.clear();
    std::unique_lock lock(mutex_);
    filled_.wait_for(lock, timeout, [&] { return closed_ || !items_.empty(); });
    taken.swap(items_);
    emptied_.notify_all();
  }

  // Waits for an item. Returns nullopt if the queue is closed and empty.
  std::optional<T> pop() {
    std::unique_lock lock(mutex_);
    filled_.wait(lock, [&] { return closed_ || !items_.empty(); });
    return take_front();
  }

  // Rejects all later pushes. The remaining items can still be popped.
  void close() {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    filled_.notify_all();
    emptied_.notify_all();
  }

  bool closed_and_empty() const {
    const std::lock_guard lock(mutex_);
    return closed_ && items_.empty();
  }
  std::uint64_t dropped() const {
    const std::lock_guard lock(mutex_);
    return dropped_;
  }

 private:
  std::optional<T> take_front() {
    if (items_.empty()) return std::nullopt;
    std::optional<T> value(std::move(items_.front()));
    items_.pop_front();
    emptied_.notify_one();
    return value;
  }

  const std::size_t capacity_;
  mutable std::mutex mutex_;
  std::condition_variable filled_, emptied_;
  std::deque<T> items_;
  std::uint64_t dropped_ = 0;
  bool closed_ = false;
};

}  // namespace mdof
