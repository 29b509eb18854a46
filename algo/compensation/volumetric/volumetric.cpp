#include "algo/compensation/volumetric/volumetric.h"

#include <algorithm>
#include <cmath>

#include "algo/compensation/volumetric/between_nodes.h"
#include "algo/compensation/volumetric/volumetric_noise.h"
#include "algo/machine/compensating.h"
#include "algo/machine/plane_map.h"
#include "schema/base/number/number_text.h"
#include "schema/sample.h"
#include "schema/units.h"

namespace mdof::algo {
namespace {

constexpr std::string_view kAxes = "XYZ";
// A command outside the grid by less than this counts as inside, because numbers in mm are rounded.
constexpr double kSamePlace_m = 1e-9;

std::string name_of(std::size_t axis) {
  return std::string(1, kAxes[axis]);
}

Result<std::vector<double>> commands_along(const Machine& machine, std::size_t axis,
                                           double step_m) {
  const MachineFrame* frame = machine.find(name_of(axis));
  if (!frame)
    return bad_input("the chain " + machine.chain.text + " has no axis " + name_of(axis) +
                     "; use only axes of this chain");
  MDOF_TRY(const auto range, range_of(*frame));
  // This check rejects a step of 0, too.
  if (!((range[1] - range[0]) / step_m < static_cast<double>(kMostVolumetricCommands) - 1))
    return bad_input("axis " + name_of(axis) + ": a range of " +
                     plain_number(to_mm(range[1] - range[0]), 6) + " mm with a step of " +
                     plain_number(to_mm(step_m), 6) + " mm has more than " +
                     std::to_string(kMostVolumetricCommands) + " nodes; use a larger step");
  return steps_over(range, step_m);
}

Status set_grid(VolumetricTable& table, const Machine& machine, const VolumetricRequest& request) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (request.along[k]) {
      MDOF_TRY(table.command_m[k], commands_along(machine, k, request.step_m));
    } else {
      table.command_m[k] = {request.others[k]};
    }
  }
  for (std::size_t k = 0; k < 3; ++k) table.rotary_rad[k] = request.others[3 + k];
  if (table.nodes() <= kMostVolumetricNodes) return {};
  return bad_input("the grid has " + std::to_string(table.nodes()) + " nodes (limit " +
                   std::to_string(kMostVolumetricNodes) + "); use a larger step");
}

std::string place_text(const Vec3& command_m) {
  std::string text;
  for (std::size_t k = 0; k < 3; ++k)
    text += (k ? " " : "") + name_of(k) + " " + plain_number(to_mm(command_m[k]), 6);
  return text + " mm";
}

// Calculates the correction and the other values of the table for one command.
class CorrectedPlace {
 public:
  static Result<CorrectedPlace> at(const Machine& machine, const VolumetricRequest& request,
                                   const Vec3& command_m) {
    CorrectedPlace p;
    p.command_ = request.others;
    std::copy(command_m.begin(), command_m.end(), p.command_.begin());
    MDOF_TRY(p.found_, compensating_command(machine, p.command_, request.approach));
    if (p.found_.converged) return p;
    return bad_input("at " + place_text(command_m) +
                     ": the errors change so steeply with the position that no commanded position "
                     "can compensate them; check the units of the error tables");
  }
  Vec3 correction_m() const {
    Vec3 c{};
    for (std::size_t k = 0; k < 3; ++k) c[k] = found_.command[k] - command_[k];
    return c;
  }
  const Command& command() const { return command_; }
  const CompensatingCommand& found() const { return found_; }

 private:
  Command command_{};
  CompensatingCommand found_;
};

// Returns u of the correction; NaN if no relevant error has an uncertainty.
Vec3 correction_uncertainty(const Machine& machine, const Command& command,
                            MachineApproach approach) {
  const Vector6 all = error_uncertainty(command_derivatives(machine, command),
                                        values_at(machine, command, approach));
  Vec3 u{};
  for (std::size_t k = 0; k < 3; ++k) {
    u[k] = all[static_cast<Eigen::Index>(k)];
    if (u[k] == 0) u[k] = kNaN;
  }
  return u;
}

// Returns whether the table contains the noise of each axis separately.
bool has_parts(const VolumetricTable& table) {
  return std::any_of(table.noise.begin(), table.noise.end(),
                     [](const auto& axis) { return !axis.empty(); });
}

Vec3 u_independent(const VolumetricTable& table, std::size_t node) {
  const std::size_t nx = table.command_m[0].size(), ny = table.command_m[1].size();
  Vec3 u = noise_variance(table, {{{node % nx}, {node / nx % ny}, {node / (nx * ny)}}},
                          table.command_at(node));
  for (double& of : u) of = std::sqrt(of);
  return u;
}

Status add_node(VolumetricTable& table, const Machine& machine, const VolumetricRequest& request,
                std::size_t node) {
  MDOF_TRY(const CorrectedPlace place,
           CorrectedPlace::at(machine, request, table.command_at(node)));
  const ToolError error = tool_error(machine, place.command(), request.approach);
  table.correction_m.push_back(place.correction_m());
  table.u_m.push_back(correction_uncertainty(machine, place.command(), request.approach));
  if (has_parts(table)) table.u_independent_m.push_back(u_independent(table, node));
  table.place_left_m = std::max(table.place_left_m, place.found().residual_m.norm());
  const Vec3 reversal = command_reversal(machine, place.command());
  const double left = request.approach == MachineApproach::mean ? 0.5 : 1;
  for (std::size_t k = 0; k < 3; ++k)
    table.reversal_m[k] = std::max(table.reversal_m[k], left * reversal[k]);
  table.turn_left_rad = std::max(table.turn_left_rad, place.found().angles_rad.norm());
  for (std::size_t k = 0; k < 3; ++k) {
    add_new(error.not_measured[k], table.not_measured);
    add_new(error.no_u[k], table.u_not_declared);
  }
  add_new(error.beyond, table.beyond_tables);
  return {};
}

// Sets the command to the node plus half a cell along each axis whose bit is set in `half` (bit 0:
// X). Returns false if the node is the last one along such an axis.
bool move_half_cell(const VolumetricTable& table, std::size_t node, unsigned half,
                    Vec3& command_m) {
  command_m = table.command_at(node);
  for (std::size_t k = 0; k < 3; ++k) {
    if (!(half >> k & 1U)) continue;
    const auto& all = table.command_m[k];
    const auto here = std::lower_bound(all.begin(), all.end(), command_m[k]);
    if (std::next(here) == all.end()) return false;
    command_m[k] = (*here + *std::next(here)) / 2;
  }
  return true;
}

// Returns for each cell of an axis the positions at which an error deviates most from the straight
// line between the two nodes. Each of these positions is in the table of the error, because the
// error is linear between the positions of its table.
std::vector<std::vector<double>> bends_along(const Machine& machine, std::size_t axis,
                                             const std::vector<double>& nodes) {
  std::vector<std::vector<double>> bends(nodes.size());
  const auto add = [&](const std::vector<double>& position, const std::vector<double>& values) {
    const auto at = [&](double x) { return value_at(values, place_of(position, x)); };
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
      const double from = at(nodes[i]), to = at(nodes[i + 1]);
      double most = 0, where = 0;
      for (std::size_t p = 0; p < position.size(); ++p) {
        const double part = (position[p] - nodes[i]) / (nodes[i + 1] - nodes[i]);
        if (!(part > 0 && part < 1)) continue;
        const double off = std::abs(values[p] - (from + (to - from) * part));
        if (off > most) most = off, where = position[p];
      }
      if (most > 0) bends[i].push_back(where);
    }
  };
  for (const MachineFrame& frame : machine.frames)
    if (frame.id == name_of(axis) || frame.moves_with == kAxes[axis])
      for (const ErrorFunction& f : frame.error)
        for (const auto* values : {&f.forward, &f.reverse})
          if (!f.position.empty() && !values->empty()) add(f.position, *values);
  for (auto& of_cell : bends) {
    std::sort(of_cell.begin(), of_cell.end());
    of_cell.erase(std::unique(of_cell.begin(), of_cell.end()), of_cell.end());
  }
  return bends;
}

// Finds the largest deviation of the corrections from linear interpolation in the cell after each
// node. The deviation is calculated in the middle of each edge, of each face and of the cell, and
// at the positions of bends_along() on an edge. Such positions of several axes can coincide, so the
// deviations of the axes are added.
class Interpolation {
 public:
  Interpolation(VolumetricTable& table, const Machine& machine, const VolumetricRequest& request)
      : table_(table), machine_(machine), request_(request) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      bends_[axis] = bends_along(machine, axis, table.command_m[axis]);
  }

  Status find(std::size_t node) {
    Vec3 middle{};
    for (unsigned half = 1; half < 8; ++half) {
      if (!move_half_cell(table_, node, half, middle)) continue;
      MDOF_TRY(const Vec3 left, left_at(middle));
      take(left);
    }
    Vec3 sum{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      MDOF_TRY(const Vec3 left, deviation_along(node, axis));
      for (std::size_t k = 0; k < 3; ++k) sum[k] += left[k];
    }
    take(sum);
    return {};
  }

 private:
  void take(const Vec3& left) {
    for (std::size_t k = 0; k < 3; ++k)
      table_.interpolation_m[k] = std::max(table_.interpolation_m[k], left[k]);
  }
  Result<Vec3> left_at(const Vec3& command_m) const {
    MDOF_TRY(const CorrectedPlace place, CorrectedPlace::at(machine_, request_, command_m));
    const Vec3 there = place.correction_m(),
               straight = volumetric_at(table_, command_m).correction_m;
    Vec3 left{};
    for (std::size_t k = 0; k < 3; ++k) left[k] = std::abs(there[k] - straight[k]);
    return left;
  }
  Result<Vec3> deviation_along(std::size_t node, std::size_t axis) const {
    Vec3 most{};
    Vec3 command_m = table_.command_at(node);
    const auto& nodes = table_.command_m[axis];
    const auto here = std::lower_bound(nodes.begin(), nodes.end(), command_m[axis]);
    for (const double bend : bends_[axis][static_cast<std::size_t>(here - nodes.begin())]) {
      command_m[axis] = bend;
      MDOF_TRY(const Vec3 left, left_at(command_m));
      for (std::size_t k = 0; k < 3; ++k) most[k] = std::max(most[k], left[k]);
    }
    return most;
  }

  VolumetricTable& table_;
  const Machine& machine_;
  const VolumetricRequest& request_;
  std::array<std::vector<std::vector<double>>, 3> bends_;  // [axis][cell]
};

Status find_interpolation(VolumetricTable& table, const Machine& machine,
                          const VolumetricRequest& request) {
  Interpolation interpolation(table, machine, request);
  for (std::size_t node = 0; node < table.nodes(); ++node) MDOF_CHECK(interpolation.find(node));
  return {};
}

// Checks the limits along each line of nodes that is parallel to this axis.
Status check_lines(const VolumetricTable& table, std::size_t axis, const TableLimits& limits) {
  const auto& commands = table.command_m[axis];
  for (std::size_t node = 0; node < table.nodes(); ++node) {
    const Vec3 from = table.command_at(node);
    if (from[axis] != commands.front()) continue;
    const std::size_t stride = axis == 0   ? 1
                               : axis == 1 ? table.command_m[0].size()
                                           : table.command_m[0].size() * table.command_m[1].size();
    for (std::size_t k = 0; k < 3; ++k) {
      std::vector<double> values;
      for (std::size_t i = 0; i < commands.size(); ++i)
        values.push_back(table.correction_m[node + i * stride][k]);
      MDOF_CHECK(check_limits("the correction of " + name_of(k) + " along " + name_of(axis) +
                                  " from " + place_text(from),
                              false, commands, values, limits));
    }
  }
  return {};
}

Status check_measured(const VolumetricTable& table, const VolumetricRequest& request) {
  if (table.not_measured.empty() || request.incomplete) return {};
  std::string names;
  for (const std::string& name : table.not_measured) names += (names.empty() ? "" : ", ") + name;
  return bad_input(
      "these errors were not measured, so the table would not correct them: " + names +
          "; add the errors to the machine file (give the value 0 if an error is known to be 0)",
      Remedy::allow_incomplete);
}

GridCell cell_of(const std::vector<double>& commands, double command) {
  const double low = commands.front(), high = commands.back();
  if (command <= low) return {0, 0, command > low - kSamePlace_m};
  const bool inside = command < high + kSamePlace_m;
  if (command >= high) return {commands.size() - 1, 0, inside};
  const auto next = std::upper_bound(commands.begin(), commands.end(), command);
  const auto index = static_cast<std::size_t>(next - commands.begin()) - 1;
  return {index, (command - commands[index]) / (commands[index + 1] - commands[index]), true};
}

// Sets u_m and its parts. Before the call, u_common_m is the common part, or the complete u if the
// table has no separate parts.
void set_u(const VolumetricTable& table, const std::array<GridCell, 3>& cell, const Vec3& command_m,
           VolumetricValue& value) {
  value.u_m = value.u_common_m;
  if (!has_parts(table)) {
    value.u_common_m = value.u_independent_m = {kNaN, kNaN, kNaN};
    return;
  }
  const Vec3 variance = noise_variance(table, cell, command_m);
  for (std::size_t k = 0; k < 3; ++k) {
    value.u_independent_m[k] = std::sqrt(variance[k]);
    value.u_m[k] = std::hypot(value.u_common_m[k], value.u_independent_m[k]);
  }
}

}  // namespace

Result<VolumetricTable> build_volumetric(const Machine& machine, const VolumetricRequest& request) {
  VolumetricTable table;
  table.name = machine.name;
  table.machine = machine.chain;
  table.simulated = machine.simulated;
  table.noise_only = noise_only(machine);
  table.approach = request.approach == MachineApproach::forward   ? "forward"
                   : request.approach == MachineApproach::reverse ? "reverse"
                                                                  : "mean";
  table.tool_m = machine.tool_m;
  MDOF_CHECK(set_grid(table, machine, request));
  set_axis_noise(table, machine, request.others, request.approach);
  for (std::size_t node = 0; node < table.nodes(); ++node)
    MDOF_CHECK(add_node(table, machine, request, node));
  MDOF_CHECK(check_measured(table, request));
  MDOF_CHECK(check_limits(table, request.limits));
  MDOF_CHECK(find_interpolation(table, machine, request));
  set_u_between_nodes(table, machine, request.others, request.approach);
  return table;
}

double largest_correction_m(const VolumetricTable& table, std::size_t axis) {
  double largest = 0;
  for (const Vec3& c : table.correction_m) largest = std::max(largest, std::abs(c[axis]));
  return largest;
}

double largest_u_m(const VolumetricTable& table, std::size_t axis) {
  double largest = 0;
  Vec3 command_m{};
  for (std::size_t node = 0; node < table.nodes(); ++node)
    for (unsigned half = 0; half < 8; ++half) {
      if (!move_half_cell(table, node, half, command_m)) continue;
      const double u = volumetric_at(table, command_m).u_m[axis];
      if (std::isnan(u)) return u;
      largest = std::max(largest, u);
    }
  return largest;
}

Status check_limits(const VolumetricTable& table, const TableLimits& limits) {
  for (std::size_t axis = 0; axis < 3; ++axis) MDOF_CHECK(check_lines(table, axis, limits));
  return {};
}

VolumetricValue volumetric_at(const VolumetricTable& table, const Vec3& command_m) {
  std::array<GridCell, 3> cell;
  VolumetricValue value;
  double bend = 0;  // share of interpolation_m: 0 at a node, 1 halfway between two nodes
  Vec3 u_between{};
  for (std::size_t k = 0; k < 3; ++k) {
    cell[k] = cell_of(table.command_m[k], command_m[k]);
    value.inside = value.inside && cell[k].inside;
    const double along = 4 * cell[k].part * (1 - cell[k].part);
    bend = std::max(bend, along);
    if (along == 0 || table.u_between_m[k].empty()) continue;
    for (std::size_t i = 0; i < 3; ++i)
      u_between[i] = std::hypot(u_between[i], along * table.u_between_m[k][cell[k].index][i]);
  }
  for (unsigned corner = 0; corner < 8; ++corner) {
    double weight = 1;
    std::array<std::size_t, 3> index{};
    for (std::size_t k = 0; k < 3; ++k) {
      const bool next = corner >> k & 1U;
      weight *= next ? cell[k].part : 1 - cell[k].part;
      index[k] = cell[k].index + (next ? 1 : 0);
    }
    if (weight == 0) continue;  // the last node has no next node
    const std::size_t node = table.node(index[0], index[1], index[2]);
    const Vec3 common = has_parts(table) ? table.u_common_at(node) : table.u_m[node];
    for (std::size_t k = 0; k < 3; ++k) {
      value.correction_m[k] += weight * table.correction_m[node][k];
      value.u_common_m[k] += weight * common[k];
    }
  }
  for (std::size_t k = 0; k < 3; ++k)
    value.u_common_m[k] =
        std::hypot(value.u_common_m[k], bend * table.interpolation_m[k], u_between[k]);
  set_u(table, cell, command_m, value);
  return value;
}

}  // namespace mdof::algo
