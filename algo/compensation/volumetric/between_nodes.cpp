#include "algo/compensation/volumetric/between_nodes.h"

#include <algorithm>
#include <cmath>

#include "algo/machine/compensating.h"
#include "schema/sample.h"

namespace mdof::algo {
namespace {

constexpr std::string_view kGridAxes = "XYZ";

// Returns the variances of the corrections without the noise that the table contains separately.
Vec3 common_variance(const VolumetricTable& table, const Machine& machine, const Command& command,
                     MachineApproach approach) {
  const auto all = command_derivatives(machine, command);
  auto values = values_at(machine, command, approach);
  const Vector6 u = error_uncertainty(all, values);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const MachineFrame& frame = machine.frames[i];
    const bool separate = frame.kind == FrameKind::linear && !table.noise[frame.direction].empty();
    values[i].u_parts = values[i].noise_parts * (separate ? 1 : 0);
    values[i].u_location = {};
    values[i].shared.clear();
  }
  const Vector6 noise = error_uncertainty(all, values);
  Vec3 variance{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    variance[k] = u[row] * u[row] - noise[row] * noise[row];
  }
  return variance;
}

// Returns for each cell of an axis the positions between its nodes at which u is calculated.
std::vector<std::vector<double>> places_between(const Machine& machine, std::size_t axis,
                                                const std::vector<double>& nodes) {
  std::vector<std::vector<double>> cells(nodes.size() - 1);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    std::vector<double> ends{nodes[i], nodes[i + 1]};
    for (const MachineFrame& frame : machine.frames)
      if (frame.id == kGridAxes.substr(axis, 1) || frame.moves_with == kGridAxes[axis])
        for (const ErrorFunction& f : frame.error)
          for (const double x : f.position)
            if (x > nodes[i] && x < nodes[i + 1]) ends.push_back(x);
    std::sort(ends.begin(), ends.end());
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    for (std::size_t j = 1; j < ends.size(); ++j) {
      cells[i].push_back((ends[j - 1] + ends[j]) / 2);
      if (j + 1 < ends.size()) cells[i].push_back(ends[j]);
    }
  }
  return cells;
}

}  // namespace

void set_u_between_nodes(VolumetricTable& table, const Machine& machine, const Command& others,
                         MachineApproach approach) {
  const bool parts = !table.u_independent_m.empty();
  const auto u_at = [&](std::size_t node) {
    return parts ? table.u_common_at(node) : table.u_m[node];
  };
  for (std::size_t axis = 0, stride = 1; axis < 3; stride *= table.command_m[axis++].size()) {
    const auto& nodes = table.command_m[axis];
    const auto cells = places_between(machine, axis, nodes);
    table.u_between_m[axis].assign(cells.size(), {kNaN, kNaN, kNaN});
    for (std::size_t node = 0; node < table.nodes(); ++node) {
      const std::size_t cell = node / stride % nodes.size();
      if (cell == cells.size()) continue;
      const Vec3 from = u_at(node), to = u_at(node + stride), start = table.command_at(node);
      Command command = others;
      std::copy(start.begin(), start.end(), command.begin());
      for (const double place : cells[cell]) {
        command[axis] = place;
        const double part = (place - nodes[cell]) / (nodes[cell + 1] - nodes[cell]);
        const Vec3 variance = common_variance(table, machine, command, approach);
        for (std::size_t k = 0; k < 3; ++k) {
          const double interpolated = from[k] + (to[k] - from[k]) * part;
          const double more = variance[k] - interpolated * interpolated;
          double& largest = table.u_between_m[axis][cell][k];
          largest = std::fmax(largest, more < 0 ? 0 : std::sqrt(more));
        }
      }
    }
  }
}

}  // namespace mdof::algo
