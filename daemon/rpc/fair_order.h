// Selects the next user of a shared thread: the one that has used the least of its time lately
// (start-time fair queueing, Goyal, Vin and Cheng 1996). A user with few requests is served before
// one with many.
#pragma once

#include <algorithm>
#include <cassert>
#include <chrono>
#include <utility>
#include <vector>

namespace mdof {

// The used time of one user, on the time scale of the order.
struct FairShare {
  std::chrono::nanoseconds end{0};
};

// Thread-bound, or protected by the owner's lock. Pure: the caller measures the cost of a turn.
template <class T>
class FairOrder {
 public:
  bool empty() const { return waiting_.empty(); }

  // `who` waits for one turn. It must not wait twice at a time.
  void add(T who, const FairShare& share) {
    waiting_.push_back({std::max(now_, share.end), std::move(who)});
  }

  // Returns the user with the least used time; if equal, the one that has waited longest. Must not
  // be empty.
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

  // Call it with the cost of a turn before the next take(). For a new user the cost delays the
  // first turn, so that repeated reconnecting gives no advantage.
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
