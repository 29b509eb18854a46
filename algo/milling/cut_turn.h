// One turn of an end mill in a steady cut: forces and deflection in equilibrium at every angle.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "algo/milling/cutting_edge.h"
#include "schema/base/result.h"
#include "schema/milling/milling_plan.h"

namespace mdof::algo {

struct CutTurn {
  // Angles of tooth 0 at the tip: steps_per_turn, rounded up to a multiple of the teeth.
  std::vector<double> turned_rad;
  std::vector<double> height_m;  // heights of the elements from the tip
  Eigen::MatrixXd fx_N, fy_N;    // on the tool; a row for each angle, a column for each element
  std::vector<double> power_W;   // cutting power, by angle
  double entry_rad = 0, exit_rad = 0;  // angles of tooth 0 in the lowest element
  int iterations = 0;                  // for the window whose edge depends on the deflection

  // Force on the whole tool: both components, a row for each angle.
  Eigen::MatrixXd force_N() const;
};

// Error (check): there is no equilibrium; names the angle and what to change.
Result<CutTurn> cut_turn(const MillingPlan& plan);

// Both components of the deflection at a height, a row for each angle.
Eigen::MatrixXd deflection_m(const MillingPlan& plan, const CutTurn& turn, double height_m);

}  // namespace mdof::algo
