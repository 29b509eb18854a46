// Changes of the means by the linear map of TargetChanges are compared with differences of the
// means. The runs lack visits, some targets were approached from one side only, and some points
// have no errors.
#include "algo/iso230/target_changes.h"

#include <gtest/gtest.h>

#include <random>

#include "algo/iso230/target_means.h"

namespace mdof::algo {
namespace {

constexpr int kTargets = 7;

struct Visits {
  int runs;
  double missing, one_sided;  // fraction of missing visits; fraction of targets with one approach
};

std::vector<MeasuredPoint> random_points(const Visits& visits, std::mt19937& random) {
  std::uniform_real_distribution<double> share(0, 1), error(-1e-6, 1e-6);
  std::vector<bool> from_one_side;
  for (int t = 0; t < kTargets; ++t) from_one_side.push_back(share(random) < visits.one_sided);
  std::vector<MeasuredPoint> points;
  for (int run = 1; run <= visits.runs; ++run)
    for (const int direction : {1, -1, 0})
      for (int target = 1; target <= kTargets; ++target) {
        if (share(random) < visits.missing) continue;
        if (from_one_side[static_cast<std::size_t>(target) - 1] && direction == target % 2 * 2 - 1)
          continue;
        MeasuredPoint& p = points.emplace_back();
        p.target = target;
        p.run = run;
        p.point.direction = direction;
        p.point.position_m = target * 5e-3;
        p.errors.valid = share(random) > 0.1;
        for (double& e : p.errors.local) e = error(random);
      }
  return points;
}

double largest_difference(const MovingAxis& moving, const std::vector<MeasuredPoint>& points,
                          std::mt19937& random) {
  std::uniform_real_distribution<double> change(-1e-6, 1e-6);
  std::vector<Errors5> changes(points.size());
  std::vector<MeasuredPoint> changed = points;
  for (std::size_t j = 0; j < points.size(); ++j)
    for (std::size_t e = 0; e < kErrorCount; ++e)
      changed[j].errors.local[e] += changes[j][e] = change(random);
  const auto before = target_means(moving, points, Approach::both);
  const auto after = target_means(moving, changed, Approach::both);
  const auto found = TargetChanges(moving, points).of(changes);
  EXPECT_EQ(found.size(), before.size());
  double most = 0;
  for (std::size_t t = 0; t < found.size() && t < before.size(); ++t)
    for (std::size_t k = 0; k < kErrorCount; ++k)
      most = std::max(most, std::abs(after[t].named[k] - before[t].named[k] - found[t][k]));
  return most;
}

TEST(TargetChanges, MatchTheChangesOfTheMeans) {
  std::mt19937 random(7);
  const Visits cases[] = {
      {3, 0, 0},     {3, 0, 0.4},    {1, 0, 1},    {4, 0.3, 0},
      {4, 0.3, 0.4}, {30, 0.2, 0.2}, {2, 0.8, 0.5}};  // 30 runs: more runs than visits of a run
  for (const Visits& visits : cases)
    for (int repeat = 0; repeat < 20; ++repeat)
      for (const Axis axis : {Axis::x, Axis::y, Axis::z}) {
        const MovingAxis moving{axis, {.fixture_moves = repeat % 2 == 1}};
        const auto points = random_points(visits, random);
        EXPECT_LT(largest_difference(moving, points, random), 1e-18)
            << visits.runs << " runs, missing " << visits.missing;
      }
}

TEST(TargetChanges, AreEmptyWithoutPoints) {
  EXPECT_TRUE(TargetChanges({Axis::x, {}}, {}).of({}).empty());
}

}  // namespace
}  // namespace mdof::algo
