// Who is next of several that share one thread: the one that has used the least of it lately
// (start-time fair queueing, Goyal, Vin and Cheng 1996). Who asks seldom is served before those
// who ask without end.
#pragma once

#include <algorithm>
#include <cassert>
#include <chrono>
#include <utility>
#include <vector>

namespace mdof {

// What one of them has used, in the order's own time.
struct FairShare {
  std::chrono::nanoseconds end{0};
};

// Thread-bound, or under its owner's lock. Pure: the cost of a turn comes from outside.
template <class T>
class FairOrder {
 public:
  bool empty() const { return waiting_.empty(); }

  // `who` waits for one turn. Nobody waits twice at a time.
  void add(T who, const FairShare& share) {
    waiting_.push_back({std::max(now_, share.end), std::move(who)});
  }

  // Of equals the one that has waited longest. Not when empty.
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

  // Before the next take(): what the turn has cost. Of a new one: so much later it begins, lest
  // one who comes anew each time is before those who have had a turn.
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
