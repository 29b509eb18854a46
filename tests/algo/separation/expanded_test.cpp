// Coverage factor and U of a separation. Machine and target are straight, so the results contain
// only noise.
#include <gtest/gtest.h>

#include <cmath>

#include "algo/separation/separate.h"
#include "schema/base/random.h"

namespace mdof::algo {
namespace {

constexpr double kNoise_m = 10e-9;

double normal(std::uint32_t trial, std::uint32_t set_up, std::uint32_t i) {
  const auto words = philox({i, set_up, trial, 0}, 7);
  return gaussian(uniform(words[0], words[1]));
}

// Three set-ups with n positions: in the second the target is shifted by a step, in the third it is
// turned over. There are n - 3 degrees of freedom.
SeparationRequest noise_only(std::uint32_t n, std::uint32_t trial) {
  SeparationRequest request;
  for (std::uint32_t k = 0; k < 3; ++k) {
    auto& set_up = request.set_ups.emplace_back();
    if (k == 1) set_up.shift_m = 5e-3;
    if (k == 2) set_up.turn.height_sign = -1;
    for (std::uint32_t i = 0; i < n; ++i) {
      set_up.position_m.push_back(5e-3 * i);
      set_up.error_m.push_back(kNoise_m * normal(trial, k, i));
    }
  }
  return request;
}

// Counts how many of the 3,000 intervals contain the true value, which is 0.
TEST(SeparationExpanded, UCoversTheTruthWithStudentsT) {
  constexpr std::uint32_t kTrials = 3000;
  for (const std::uint32_t n : {4U, 6U}) {
    int held = 0, covered_by_two_u = 0;
    for (std::uint32_t trial = 0; trial < kTrials; ++trial) {
      const auto found = separate(noise_only(n, trial));
      ASSERT_TRUE(found) << found.error().message;
      ASSERT_EQ(found->freedom(), n - 3);
      EXPECT_EQ(found->machine.freedom[1], n - 3);
      const double off_m = std::abs(found->machine.seen_m[1]);
      held += off_m <= found->machine.U_m(1);
      covered_by_two_u += off_m <= 2 * found->machine.u_m[1];
    }
    // 95 % ± three standard deviations of the share for 3,000 trials.
    EXPECT_NEAR(100.0 * held / kTrials, 95, 1.2) << n;
    EXPECT_LT(100.0 * covered_by_two_u / kTrials, 88) << n;
  }
}

// A target that was not turned and shifted looks like a flat target: all its shape is in the error
// of the machine.
TEST(SeparationExpanded, ReportsATargetThatShowsNoShape) {
  const auto with_shapes = [](double of_machine, double of_target) {
    auto request = noise_only(12, 1);
    for (auto& set_up : request.set_ups) {
      set_up.u_m.assign(12, kNoise_m);
      for (std::size_t i = 0; i < 12; ++i) {
        const double c = -set_up.position_m[i] - set_up.shift_m;
        set_up.error_m[i] += of_machine * std::sin(400 * set_up.position_m[i]) +
                             set_up.turn.height_sign * of_target * std::cos(250 * c);
      }
    }
    return separate(request).value().notices;
  };
  const auto found = with_shapes(1e-6, 0);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].code, NoticeCode::target_shows_no_shape);
  EXPECT_EQ(found[0].severity, Severity::information);
  EXPECT_TRUE(with_shapes(1e-6, 100e-9).empty());
}

// The factors 12.71 and 1.960 are from GUM table G.2. For values between them, the degrees of
// freedom follow from equation G.2b.
TEST(SeparationExpanded, DeclaredUHasInfiniteDegreesOfFreedom) {
  auto request = noise_only(4, 1);
  const auto scatter = separate(request).value();
  EXPECT_NEAR(scatter.machine.k[1], 12.71, 0.01);
  EXPECT_NEAR(scatter.machine.U_m(1), 12.71 * scatter.machine.u_m[1],
              1e-3 * scatter.machine.U_m(1));
  for (auto& set_up : request.set_ups) set_up.declared = {{"", {0, 30e-9, 0, 0}}};
  const auto both = separate(request).value();
  // The degrees of freedom are u^4 / (u_s^4 / 1); u_s is the u of the scatter alone.
  const double ratio = both.machine.u_m[1] / scatter.machine.u_m[1];
  EXPECT_GT(ratio, 1);
  EXPECT_NEAR(both.machine.freedom[1] / std::pow(ratio, 4), 1, 1e-9);
  for (auto& set_up : request.set_ups) set_up.u_m.assign(4, kNoise_m);
  const auto known = separate(request).value();
  EXPECT_NEAR(known.machine.k[1], 1.960, 1e-3);
  EXPECT_TRUE(std::isinf(known.machine.freedom[1]));
}

TEST(SeparationExpanded, HasNoFactorWithoutUAndFreedom) {
  auto request = noise_only(6, 1);
  request.set_ups.erase(request.set_ups.begin() + 1);
  const auto found = separate(request).value();
  EXPECT_EQ(found.freedom(), 0U);
  for (const double x :
       {found.machine.u_m[0], found.machine.k[0], found.machine.freedom[0], found.target.U_m(0)})
    EXPECT_TRUE(std::isnan(x));
}

}  // namespace
}  // namespace mdof::algo
