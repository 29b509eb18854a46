#include "algo/machine/compensating.h"

#include "algo/linear_algebra/least_squares.h"

namespace mdof::algo {
namespace {

constexpr int kMostSteps = 50;
constexpr double kStill_m = 1e-12;

using Jacobian = Eigen::Matrix<double, 3, Eigen::Dynamic>;

std::vector<std::size_t> linear_axes(const Machine& machine) {
  std::vector<std::size_t> directions;
  for (const MachineFrame& frame : machine.frames)
    if (frame.kind == FrameKind::linear) directions.push_back(frame.direction);
  return directions;
}

// The nominal machine is linear in the commands of its linear axes.
Jacobian jacobian(const Machine& machine, const Command& at,
                  const std::vector<std::size_t>& directions) {
  Jacobian J(3, static_cast<Eigen::Index>(directions.size()));
  const Eigen::Vector3d here = nominal_tool(machine, at).p;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    Command moved = at;
    moved[directions[i]] += 1;
    J.col(static_cast<Eigen::Index>(i)) = nominal_tool(machine, moved).p - here;
  }
  return J;
}

}  // namespace

Result<CompensatingCommand> compensating_command(const Machine& machine, const Command& wanted,
                                                 MachineApproach approach) {
  const auto directions = linear_axes(machine);
  if (directions.empty())
    return bad_input("the chain " + machine.chain.text +
                     " has no linear axis whose command could be corrected");
  const LeastNorm inverse(jacobian(machine, wanted, directions));
  const Eigen::Vector3d target = nominal_tool(machine, wanted).p;
  CompensatingCommand c;
  c.command = wanted;
  for (c.steps = 0; c.steps < kMostSteps && !c.converged; ++c.steps) {
    const Pose reached = actual_tool(machine, values_at(machine, c.command, approach));
    const Eigen::VectorXd step = inverse.solve(Eigen::VectorXd(target - reached.p));
    for (std::size_t i = 0; i < directions.size(); ++i)
      c.command[directions[i]] += step[static_cast<Eigen::Index>(i)];
    c.converged = step.norm() < kStill_m;
  }
  const auto values = values_at(machine, c.command, approach);
  c.residual_m = actual_tool(machine, values).p - target;
  c.angles_rad = exact_error(machine, c.command, values).tail<3>();
  for (std::size_t i = 0; i < values.size(); ++i)
    for (std::size_t k = 0; k < kBodyErrors; ++k)
      if (values[i].beyond[k]) c.beyond.push_back(error_name(machine.frames[i], k));
  return c;
}

}  // namespace mdof::algo
