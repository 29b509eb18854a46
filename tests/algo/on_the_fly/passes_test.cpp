#include "algo/on_the_fly/passes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "algo/on_the_fly/target_grid.h"
#include "algo/points/frame_rows.h"

namespace mdof::algo {
namespace {

// First and last position in whole µm; direction.
using PassFound = std::tuple<double, double, int>;

FrameBlock frames_over_turns(const std::vector<double>& turns_mm) {
  FrameBlock frames = empty_frames(1);
  for (std::size_t leg = 1; leg < turns_mm.size(); ++leg) {
    for (int i = 0; i < 1000; ++i) {
      frames.time_ns.push_back(static_cast<std::int64_t>(frames.time_ns.size()) * 1'000'000);
      frames.encoder_m.push_back(
          1e-3 * (turns_mm[leg - 1] + (turns_mm[leg] - turns_mm[leg - 1]) * i / 1000));
      frames.probe_m[0].push_back(0);
    }
  }
  return frames;
}

std::vector<PassFound> find_all_passes(const FrameBlock& frames, std::size_t block) {
  std::vector<PassFound> found;
  const auto take = [&](const AxisPass& pass) {
    const auto at = [&](std::size_t row) { return std::round(1e6 * pass.frames.encoder_m[row]); };
    found.emplace_back(at(pass.first), at(pass.last - 1), pass.direction);
  };
  PassFinder finder;
  for (std::size_t i = 0; i < frames.size(); i += block)
    EXPECT_TRUE(finder.push(frames, i, std::min(frames.size(), i + block), take));
  finder.flush(take);
  return found;
}

TEST(PassFinder, FindsTheSamePassesForAnyBlockSize) {
  auto frames = frames_over_turns({5, 5, 20, 20, 0, 0.03, 0, 10});
  frames.encoder_m[1500] += 1e-3;  // a spike, which is no turn
  const auto whole = find_all_passes(frames, frames.size());
  ASSERT_EQ(whole.size(), 3U);
  EXPECT_EQ(whole[0], (PassFound{5000, 20000, 1}));
  EXPECT_EQ(std::get<1>(whole[1]), 0);
  EXPECT_EQ(std::get<2>(whole[1]), -1);
  EXPECT_EQ(std::get<2>(whole[2]), 1);
  for (const std::size_t block : {1U, 7U, 1000U}) EXPECT_EQ(find_all_passes(frames, block), whole);
}

TEST(PassFinder, FindsNoPassesAtStandstill) {
  EXPECT_TRUE(find_all_passes(frames_over_turns({3, 3, 3.04, 3}), 100).empty());
}

OnTheFlyOptions every(double interval_mm, double bin_mm = 0) {
  OnTheFlyOptions options;
  options.interval_mm = interval_mm;
  options.bin_mm = bin_mm;
  return options;
}

OnTheFlyOptions every_from_to(double interval_mm, double from_mm, double to_mm) {
  OnTheFlyOptions options = every(interval_mm);
  options.from_mm = from_mm;
  options.to_mm = to_mm;
  return options;
}

TEST(TargetGrid, HasWholeBinsOnly) {
  const TargetGrid grid(every(1), {});
  const auto targets = grid.between(-1.4e-3, 2.5e-3, 100);
  ASSERT_EQ(targets.size(), 3U);  // 0, 1, 2 mm; the bin at -1 mm would begin at -1.5 mm
  EXPECT_EQ(targets.front().position_m, 0);
  EXPECT_EQ(targets.back().position_m, 2e-3);
  EXPECT_TRUE(grid.known().empty());
  EXPECT_TRUE(grid.between(-1, 1, 100).empty());
  const TargetGrid tenths(every_from_to(0.1, 0, 0.5), {});
  ASSERT_EQ(tenths.known().size(), 6U);
  EXPECT_EQ(tenths.known()[3].position_m, 0.3e-3);
  const TargetGrid given(every(0), {1e-3, 8e-3});
  EXPECT_EQ(given.bin_m(), 1e-3);
  EXPECT_EQ(given.between(0, 5e-3, 10).size(), 1U);
}

TEST(TargetGrid, RejectsOptionsWithoutTargets) {
  for (const OnTheFlyOptions& wrong :
       {every(0), every(-1), every(std::nan("")), every(1, 2), every(1e-6), every_from_to(1, 2, 1),
        every_from_to(1, std::nan(""), 1), every_from_to(1, 0, INFINITY),
        every_from_to(0.001, 0, 60)}) {
    const auto status = check_on_the_fly(wrong, {});
    ASSERT_FALSE(status) << wrong.json();
    EXPECT_EQ(status.error().code, ErrorCode::usage);
  }
  EXPECT_TRUE(check_on_the_fly({}, {}));
  EXPECT_TRUE(check_on_the_fly(every_from_to(1, 0, 60), {}));
}

// The end of a log ends its last pass. Later frames begin a new pass.
TEST(PassFinder, StartsANewPassAfterFlush) {
  std::vector<PassFound> found;
  const auto take = [&](const AxisPass& pass) {
    const auto at = [&](std::size_t row) { return std::round(1e6 * pass.frames.encoder_m[row]); };
    found.emplace_back(at(pass.first), at(pass.last - 1), pass.direction);
  };
  PassFinder finder;
  for (const auto& turns : {std::vector<double>{0, 10}, {20, 10}, {5, 15}}) {
    const FrameBlock frames = frames_over_turns(turns);
    EXPECT_TRUE(finder.push(frames, 0, frames.size(), take));
    finder.flush(take);
  }
  EXPECT_EQ(found, (std::vector<PassFound>{{0, 9990, 1}, {20000, 10010, -1}, {5000, 14990, 1}}));
}

}  // namespace
}  // namespace mdof::algo
