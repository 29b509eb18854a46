// Requests for a separation that are accepted or refused, on both sides of each limit.
#include "algo/separation/request_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

namespace mdof::algo {
namespace {

SetUp set_up_of(std::size_t readings, double height_sign) {
  SetUp set_up;
  for (std::size_t i = 0; i < readings; ++i) {
    set_up.position_m.push_back(1e-3 * static_cast<double>(i));
    set_up.error_m.push_back(1e-6);
    set_up.u_m.push_back(1e-8);
  }
  set_up.turn.height_sign = height_sign;
  return set_up;
}

// Two set-ups of three readings; the target is turned over. `change` is made in the second one.
std::string refusal_of_request(const std::function<void(mdof::algo::SetUp&)>& change) {
  SeparationRequest request;
  request.set_ups = {set_up_of(3, 1), set_up_of(3, -1)};
  change(request.set_ups[1]);
  const Status status = check_request(request);
  return status ? "" : status.error().message;
}

bool says_of_request(const std::string& said, const char* expected) {
  return said.find(expected) != std::string::npos;
}

TEST(RequestCheck, EachSetUpNeedsThreeReadings) {
  EXPECT_EQ(refusal_of_request([](mdof::algo::SetUp&) {}), "");
  EXPECT_TRUE(
      says_of_request(refusal_of_request([](mdof::algo::SetUp& s) { s = set_up_of(2, -1); }),
                      "set-up 2: 2 readings, but at least 3"));
  SeparationRequest one;
  one.set_ups = {set_up_of(3, 1)};
  EXPECT_TRUE(says_of_request(check_request(one).error().message, "one set-up cannot separate"));
}

TEST(RequestCheck, NumbersAreFiniteAndBelow1000Km) {
  for (const double x : {1e6, -1e6, 1.001e6, -1.001e6, HUGE_VAL, std::nan("")}) {
    const bool good = std::abs(x) <= 1e6;
    const auto refused = [&](const std::function<void(mdof::algo::SetUp&)>& change,
                             const char* expected) {
      const std::string said = refusal_of_request(change);
      EXPECT_EQ(said.empty(), good) << x << said;
      EXPECT_TRUE(good || says_of_request(said, expected)) << said;
    };
    refused([&](mdof::algo::SetUp& s) { s.position_m[2] = x; },
            "set-up 2: a value is not a finite number");
    refused([&](mdof::algo::SetUp& s) { s.error_m[0] = x; },
            "set-up 2: a value is not a finite number");
    refused([&](mdof::algo::SetUp& s) { s.shift_m = x; }, "set-up 2: the shift is not");
    SeparationRequest request;
    request.set_ups = {set_up_of(3, 1), set_up_of(3, -1)};
    request.at.place_m = x;
    EXPECT_EQ(check_request(request).has_value(), good);
  }
  EXPECT_EQ(refusal_of_request([](mdof::algo::SetUp& s) { s.u_m[1] = 0; }), "");
  EXPECT_TRUE(says_of_request(refusal_of_request([](mdof::algo::SetUp& s) { s.u_m[1] = -1e-12; }),
                              "set-up 2: a standard uncertainty is negative"));
  EXPECT_TRUE(says_of_request(refusal_of_request([](mdof::algo::SetUp& s) { s.u_m[1] = 2e6; }),
                              "a value is"));
}

TEST(RequestCheck, ThreeThousandReadingsAreTheMost) {
  for (const std::size_t second : {1500u, 1501u}) {
    SeparationRequest request;
    request.set_ups = {set_up_of(1500, 1), set_up_of(second, -1)};
    const Status status = check_request(request);
    EXPECT_EQ(status.has_value(), second == 1500);
    if (!status) {
      EXPECT_TRUE(says_of_request(status.error().message, "have 3001 readings, but at most 3000"));
    }
  }
}

// The target must be turned or shifted by more than the distance within which places are the same.
TEST(RequestCheck, TheTargetIsTurnedOrShifted) {
  const auto alike = [](double shift_m, bool end_for_end, double height_sign) {
    const std::string said = refusal_of_request([&](mdof::algo::SetUp& s) {
      s.shift_m = shift_m;
      s.turn.end_for_end = end_for_end;
      s.turn.height_sign = height_sign;
    });
    return says_of_request(said, "the same position and orientation in all set-ups");
  };
  EXPECT_TRUE(alike(0, false, 1));
  EXPECT_TRUE(alike(19e-6, false, 1));
  EXPECT_TRUE(alike(-19e-6, false, 1));
  EXPECT_FALSE(alike(21e-6, false, 1));
  EXPECT_FALSE(alike(-21e-6, false, 1));
  EXPECT_FALSE(alike(0, true, 1));
  EXPECT_FALSE(alike(0, false, -1));
}

}  // namespace
}  // namespace mdof::algo
