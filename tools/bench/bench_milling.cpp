// Measures the processor time in s for force, deflection and wall of the paper's end mill over 1 mm
// of wall, with 10^6 tool positions and the default grid. 1 mm is 33 1/3 turns of 30 µm; each turn
// has 30,000 positions. The cut is steady, and mdof calculates only one turn.
#include <cstdio>
#include <ctime>

#include "algo/milling/milling.h"

int main() {
  auto declared = mdof::parse_milling_plan(mdof::micro_end_mill_preset(), "preset").value();
  mdof::MillingPlan& plan = declared.plan;
  const double turns = 1e-3 / (plan.feed_per_tooth_m * plan.teeth);
  plan.steps_per_turn = static_cast<int>(1e6 / turns + 0.5);
  bool missed = false;
  for (const auto model : {mdof::DeflectionModel::paper, mdof::DeflectionModel::steady}) {
    plan.deflection = model;
    const std::clock_t begin = std::clock();
    const auto result = mdof::algo::milling(plan);
    const double took_s = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    missed = missed || !result || took_s > 10;
    std::printf(
        "milling, %s: %.2f s (limit 10 s) for 1 mm of wall: %.1f turns with %d tool positions "
        "each, wall points every %.3f µm; waviness at the tip %.4f µm\n",
        mdof::to_string(model), took_s, turns, plan.steps_per_turn, plan.wall_grid_m * 1e6,
        result ? result->wall.waviness_tip_m * 1e6 : 0);
  }
  return missed ? 1 : 0;
}
