// Effect of the errors in a table on a point beside the fixture. The displacement is calculated by
// the vectors of a small rotation, its u by the machine model, tool_error().
#pragma once

#include <Eigen/Geometry>
#include <limits>

#include "algo/compensation/error_covariance.h"
#include "algo/machine/tool_error.h"
#include "schema/machine/machine.h"

namespace mdof::test {

// Displacement of a point of the body by the errors in one row: shift + rotation x arm.
inline Eigen::Vector3d moved_by(const CompensationTable& table, std::size_t row,
                                const Eigen::Vector3d& point_m) {
  Eigen::Vector3d shift = Eigen::Vector3d::Zero(), turn = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < kErrorCount; ++k) {
    const char kind = error_names(table.axis)[k].name[1];
    (kind < 'D' ? turn(kind - 'A') : shift(kind - 'X')) = table.forward[k][row];
  }
  return shift + turn.cross(point_m);
}

// A machine with one axis that carries the tool at `point_m`; the errors of the table apply at the
// fixture. If `covariances` is empty, each error has its own u and no covariances.
inline Machine machine_of(const CompensationTable& table, const Eigen::Vector3d& point_m,
                          const algo::ErrorCovariances& covariances) {
  Machine machine;
  machine.tool_m = {point_m.x(), point_m.y(), point_m.z()};
  MachineFrame& frame = machine.frames.emplace_back();
  frame.id = std::string(1, letter(table.axis));
  frame.kind = FrameKind::linear;
  frame.direction = static_cast<std::size_t>(letter(table.axis) - 'X');
  frame.point_moves = true;
  std::array<std::size_t, kErrorCount> of{};
  for (std::size_t k = 0; k < kErrorCount; ++k) {
    of[k] = std::string_view("XYZABC").find(error_names(table.axis)[k].name[1]);
    ErrorFunction& f = frame.error[of[k]];
    f.position = table.position_m;
    f.forward = table.forward[k];
    for (std::size_t row = 0; row < table.position_m.size(); ++row)
      f.u.push_back(table.u_of(table.u_forward, k, row));
  }
  if (covariances.noise.empty()) return machine;
  ErrorCovariance& all = frame.covariance;
  all.position = table.position_m;
  for (const std::size_t k : of) all.has[k] = true;
  for (std::size_t row = 0; row < table.position_m.size(); ++row) {
    all.noise.emplace_back();
    all.declared.emplace_back();
    for (std::size_t k = 0; k < kErrorCount; ++k)
      for (std::size_t l = 0; l < kErrorCount; ++l) {
        all.noise[row][of[k]][of[l]] = covariances.noise[row][k * kErrorCount + l];
        if (!covariances.declared.empty())
          all.declared[row][of[k]][of[l]] = covariances.declared[row][k * kErrorCount + l];
      }
  }
  return machine;
}

// u of the tool position if the axis is at the position in a row of the table.
inline Eigen::Vector3d tool_uncertainty(const Machine& machine, const CompensationTable& table,
                                        std::size_t row) {
  algo::Command command{};
  command[machine.frames.front().direction] = table.position_m[row];
  return algo::tool_error(machine, command, algo::MachineApproach::forward).u.head<3>();
}

}  // namespace mdof::test
