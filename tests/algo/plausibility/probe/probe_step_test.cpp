// Tests the rule of probe_step.h on both sides of each limit, with columns that are calculated by
// hand. Mutation tests (tests/mutate) found these cases.
#include "algo/plausibility/probe/probe_step.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace mdof::algo {
namespace {

constexpr std::size_t kRows = 40, kAt = 17;

// Three probes and an axis at rest. A test adds changes to them. Probe B steps by 1 um.
struct Rows {
  FrameBlock frames;

  explicit Rows(std::size_t at = kAt, double size_m = 1e-6) {
    frames.encoder_m.assign(kRows, 0);
    frames.probe_m.assign(3, std::vector<double>(kRows, 0));
    frames.probe_quality.resize(3);
    for (std::size_t i = 0; i < kRows; ++i)
      frames.time_ns.push_back(1'000'000 * static_cast<std::int64_t>(i));
    for (std::size_t i = at; i < kRows; ++i) frames.probe_m[1][i] = size_m;
  }
  // Adds `by_m` to every second row, from row `from` to before row `to`.
  void shake(std::vector<double>& x, double by_m, std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; i += 2) x[i] += by_m;
  }
  std::vector<ProbeStep> steps(std::size_t begin = 0, std::size_t first = 10, std::size_t last = 20,
                               std::size_t end = kRows) const {
    return find_steps(frames, begin, first, last, end);
  }
};

TEST(ProbeStepRule, FindsProbeRowAndSizeOfAStep) {
  for (const double size_m : {1e-6, -3e-6}) {
    for (const std::size_t at : {10u, 11u, 15u, 18u, 19u}) {
      const auto found = Rows(at, size_m).steps();
      ASSERT_EQ(found.size(), 1u) << at;
      EXPECT_EQ(found[0].probe, 1u);
      EXPECT_EQ(found[0].row, at);
      EXPECT_EQ(found[0].size_m, size_m);
    }
  }
}

TEST(ProbeStepRule, FindsStepsFromFirstToBeforeLast) {
  EXPECT_TRUE(Rows(9).steps().empty());
  EXPECT_TRUE(Rows(20).steps().empty());
  EXPECT_TRUE(Rows(kRows).steps().empty());
}

// The size is calculated from three readings on each side. The reading next to the step is not
// used.
TEST(ProbeStepRule, NeedsThreeSettledReadingsOnEachSide) {
  EXPECT_EQ(Rows(4).steps(0, 2, 20).size(), 1u);
  EXPECT_EQ(Rows(3).steps(0, 2, 20).size(), 0u);
  EXPECT_EQ(Rows(36).steps(0, 10, 38).size(), 1u);
  EXPECT_EQ(Rows(37).steps(0, 10, 38).size(), 0u);
  EXPECT_EQ(Rows(14).steps(10, 12, 20).size(), 1u);
  EXPECT_EQ(Rows(13).steps(10, 12, 20).size(), 0u);
  EXPECT_EQ(Rows(17).steps(0, 1, 20).size(), 0u);  // no surrounding readings to compare with
  EXPECT_EQ(Rows(17).steps(0, 10, 39).size(), 0u);
}

// The size is the difference between the medians of three readings on each side, without the
// reading next to the step. One of the three readings may deviate.
TEST(ProbeStepRule, SizeIsTheMedianOfThreeReadings) {
  Rows rows;
  rows.frames.probe_m[1][kAt - 2] = rows.frames.probe_m[1][kAt - 1] = -0.4e-6;
  rows.frames.probe_m[1][kAt + 3] = rows.frames.probe_m[1][kAt + 4] = 1.4e-6;
  ASSERT_EQ(rows.steps(0, 10, 24).size(), 1u);
  EXPECT_EQ(rows.steps(0, 10, 24)[0].size_m, 1e-6);
}

TEST(ProbeStepRule, LaterReadingsKeepSixTenthsOfTheStep) {
  for (const double left : {0.61, 0.59}) {
    Rows rows;
    for (std::size_t i = kAt + 1; i < kRows; ++i) rows.frames.probe_m[1][i] = left * 1e-6;
    EXPECT_EQ(rows.steps().size(), left > 0.6 ? 1u : 0u) << left;
    for (std::size_t i = kAt + 1; i < kRows; ++i) rows.frames.probe_m[1][i] = -left * 1e-6;
    EXPECT_EQ(rows.steps().size(), 0u);
  }
}

TEST(ProbeStepRule, IsAtLeastEightTimesTheSurroundingChanges) {
  for (const bool before : {true, false}) {
    for (const double times : {8.1, 7.9}) {
      Rows rows;
      const std::size_t from = before ? 1 : 25;
      rows.shake(rows.frames.probe_m[1], 1e-6 / times, from, from + 6);
      EXPECT_EQ(rows.steps().size(), times > 8 ? 1u : 0u) << times;
    }
  }
}

TEST(ProbeStepRule, IsRejectedIfAnotherProbeStepsByAQuarter) {
  for (const std::size_t other : {0u, 2u}) {
    for (const double share : {0.24, 0.26}) {
      Rows rows;
      rows.frames.probe_m[other][12] = -share * 1e-6;
      EXPECT_EQ(rows.steps().size(), share < 0.25 ? 1u : 0u) << other << " " << share;
    }
  }
}

// The axis may move by up to 2 um plus twice its movement in the surrounding rows.
TEST(ProbeStepRule, IsRejectedIfTheAxisMoves) {
  for (const double moves_um : {1.9, 2.1}) {
    Rows rows;
    for (std::size_t i = 14; i < kRows; ++i) rows.frames.encoder_m[i] = -1e-6 * moves_um;
    EXPECT_EQ(rows.steps().size(), moves_um < 2 ? 1u : 0u) << moves_um;
    rows.shake(rows.frames.encoder_m, 10e-6, 1, 7);
    EXPECT_EQ(rows.steps().size(), 1u);
    for (std::size_t i = 14; i < kRows; ++i) rows.frames.encoder_m[i] = 21.9e-6;
    EXPECT_EQ(rows.steps().size(), 1u);
    for (std::size_t i = 14; i < kRows; ++i) rows.frames.encoder_m[i] = 22.1e-6;
    EXPECT_EQ(rows.steps().size(), 0u);
  }
}

TEST(ProbeStepRule, NeedsGoodReadings) {
  Rows rows;
  rows.frames.probe_quality[1].assign(kRows, Quality::good);
  EXPECT_EQ(rows.steps().size(), 1u);
  for (const std::size_t bad : std::vector<std::size_t>{0, kRows - 1}) {
    Rows marked = rows;
    marked.frames.probe_quality[1][bad] = Quality::missing;
    EXPECT_EQ(marked.steps().size(), 0u) << bad;
    EXPECT_EQ(marked.steps(1, 10, 20, kRows - 1).size(), 1u) << bad;
  }
}

// The noise of the encoder is 2 um. If the axis moves by more than 2 um at the step, this movement
// explains the change of the reading.
TEST(ProbeStepRule, AxisWithinItsNoiseIsAtRest) {
  for (const auto& [by_m, count] : {std::pair(1.9e-6, 1U), {2.1e-6, 0U}}) {
    Rows rows;
    for (std::size_t i = kAt; i < kRows; ++i) rows.frames.encoder_m[i] = by_m;
    EXPECT_EQ(rows.steps().size(), count) << by_m;
    Rows restless;  // twice the movement in the surrounding rows is permitted, too
    restless.shake(restless.frames.encoder_m, 0.5e-6, 21, kRows);
    for (std::size_t i = kAt; i < kRows; ++i) restless.frames.encoder_m[i] += by_m + 1e-6;
    EXPECT_EQ(restless.steps().size(), count) << by_m;
  }
}

// The size uses the median of three readings on each side, so the order of the readings has no
// effect.
TEST(ProbeStepRule, OneOfThreeReadingsMayDeviate) {
  for (const std::size_t at : {kAt + 1, kAt + 2, kAt + 3, kAt - 4, kAt - 3, kAt - 2})
    for (const double off_m : {-0.1e-6, 0.1e-6}) {
      Rows rows;
      rows.frames.probe_m[1][at] += off_m;
      const auto found = rows.steps();
      ASSERT_EQ(found.size(), 1U) << at;
      EXPECT_NEAR(found[0].size_m, 1e-6, 1e-18) << at;
      EXPECT_EQ(found[0].row, kAt);
    }
}

}  // namespace
}  // namespace mdof::algo
