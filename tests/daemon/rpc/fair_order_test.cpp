#include "daemon/rpc/fair_order.h"

#include <gtest/gtest.h>

#include <map>
#include <string>

namespace mdof {
namespace {

using std::chrono::milliseconds;

// Members that request another turn after each turn. Each member has a price: the time of one of
// its turns.
class Busy {
 public:
  explicit Busy(std::map<char, int> price_ms) : price_ms_(std::move(price_ms)) {
    for (const auto& [who, ms] : price_ms_) order_.add(who, shares_[who]);
  }
  std::string turns(int count) {
    std::string who;
    for (int i = 0; i < count; ++i) {
      const char next = order_.take();
      who += next;
      order_.charge(shares_[next], milliseconds(price_ms_.at(next)));
      if (!leaves_.contains(next)) order_.add(next, shares_[next]);
    }
    return who;
  }
  void come(char who, int ms) {
    price_ms_[who] = ms;
    leaves_.insert({who, true});
    order_.add(who, shares_[who]);
  }

 private:
  std::map<char, int> price_ms_;
  std::map<char, bool> leaves_;  // members that leave after one turn
  std::map<char, FairShare> shares_;
  FairOrder<char> order_;
};

TEST(FairOrder, MembersOfEqualPriceAlternate) {
  EXPECT_EQ(Busy({{'a', 1}, {'b', 1}, {'c', 1}}).turns(7), "abcabca");
}

TEST(FairOrder, AMemberOfTripleCostHasAThirdOfTheTurns) {
  const std::string turns = Busy({{'a', 1}, {'b', 3}}).turns(80);
  EXPECT_NEAR(std::count(turns.begin(), turns.end(), 'b'), 20, 1) << turns;
}

TEST(FairOrder, AnOccasionalMemberIsServedSoon) {
  Busy busy({{'a', 50}, {'b', 50}, {'c', 50}});
  busy.turns(30);
  for (int i = 0; i < 10; ++i) {
    busy.come('x', 1);
    EXPECT_LE(busy.turns(4).find('x'), 3u) << i;
  }
}

TEST(FairOrder, NewMembersDoNotBlockTheOthers) {
  FairOrder<char> order;
  const auto come = [&order] {
    FairShare fresh;
    order.charge(fresh, milliseconds(1));
    order.add('n', fresh);
  };
  FairShare stays;
  order.add('s', stays);
  for (int i = 0; i < 5; ++i) come();
  int served = 0;
  for (int turn = 0; turn < 600; ++turn) {
    const char next = order.take();
    FairShare gone;
    order.charge(next == 's' ? stays : gone, milliseconds(1));
    if (next == 's') {
      ++served;
      order.add('s', stays);
    } else {
      come();  // a new member replaces the member that leaves
    }
  }
  EXPECT_NEAR(served, 100, 10);
}

TEST(FairOrder, AnIdleMemberGetsNoExtraTurnsLater) {
  Busy busy({{'a', 1}});
  busy.turns(1000);
  busy.come('x', 100);
  EXPECT_LE(busy.turns(2).find('x'), 1u);
  busy.come('x', 100);
  EXPECT_EQ(busy.turns(50).find('x'), std::string::npos);
}

}  // namespace
}  // namespace mdof
