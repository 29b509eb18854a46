// Calculates one turn of an end mill in a steady cut. At every angle, forces and deflection are in
// equilibrium.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "algo/milling/cutting_edge.h"
#include "schema/base/result.h"
#include "schema/milling/milling_plan.h"

namespace mdof::algo {

struct CutTurn {
  // Angles of tooth 0 at the tip. Their number is steps_per_turn, rounded up to a multiple of the
  // number of teeth.
  std::vector<double> turned_rad;
  std::vector<double> height_m;  // heights of the elements from the tip
  Eigen::MatrixXd fx_N, fy_N;    // force on the tool: [angle][element]
  std::vector<double> power_W;   // cutting power, by angle
  // Angles at which tooth 0 enters and leaves the workpiece in the lowest element.
  double entry_rad = 0, exit_rad = 0;
  int iterations = 0;  // largest number of iterations for one equilibrium

  // Returns the force on the whole tool: one row for each angle, columns x and y.
  Eigen::MatrixXd force_N() const;
};

// Error (check): there is no equilibrium; the error states the angle and what to change.
Result<CutTurn> cut_turn(const MillingPlan& plan);

// Returns the deflection at a height: one row for each angle, columns x and y.
Eigen::MatrixXd deflection_m(const MillingPlan& plan, const CutTurn& turn, double height_m);

}  // namespace mdof::algo
