// Selects the next user of a shared thread: the user that has used the thread for the shortest time
// recently (start-time fair queueing, Goyal, Vin and Cheng 1996). A user with few requests
// therefore comes before a user with many requests.
#pragma once

#include <algorithm>
#include <cassert>
#include <chrono>
#include <utility>
#include <vector>

namespace mdof {

// The time that one user has used, on the virtual time scale of FairOrder.
struct FairShare {
  std::chrono::nanoseconds end{0};
};

// Thread-bound, or protected by the owner's lock. The class reads no clock: the caller measures the
// duration of a turn.
template <class T>
class FairOrder {
 public:
  bool empty() const { return waiting_.empty(); }

  // Adds `who` to the queue for one turn. `who` must not be in the queue already.
  void add(T who, const FairShare& share) {
    waiting_.push_back({std::max(now_, share.end), std::move(who)});
  }

  // Removes and returns the user with the shortest used time. If several users have the same time,
  // returns the one that was added first. The queue must not be empty.
  T take() {
    assert(!waiting_.empty());
    const auto next =
        std::min_element(waiting_.begin(), waiting_.end(),
                         [](const Entry& a, const Entry& b) { return a.start < b.start; });
    now_ = next->start;
    T who = std::move(next->who);
    waiting_.erase(next);
    return who;
  }

  // Adds the duration `cost` of a turn to the used time of a user. Call this function before the
  // next take(). For a new user, call it with a duration that delays the first turn of this user;
  // then a client that connects again and again has no advantage.
  void charge(FairShare& share, std::chrono::nanoseconds cost) { share.end = now_ + cost; }

  template <class Condition>
  void remove_if(Condition condition) {
    std::erase_if(waiting_, [&](const Entry& entry) { return condition(entry.who); });
  }

 private:
  struct Entry {
    std::chrono::nanoseconds start;
    T who;
  };
  std::vector<Entry> waiting_;
  std::chrono::nanoseconds now_{0};
};

}  // namespace mdof
