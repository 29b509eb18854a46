#include "algo/machine/grid_chain.h"

#include <algorithm>
#include <cmath>

#include "schema/sample.h"

namespace mdof::algo {
namespace {

// Relative to the largest variance of a parabola: smaller values are rounding.
constexpr double kParabolaRounding = 2e-15;

bool moves_along(const MachineFrame& frame, std::size_t direction) {
  const char axis = "XYZ"[direction];
  if (frame.moves_with != 0) return frame.moves_with == axis;
  return frame.kind == FrameKind::linear && frame.id[0] == axis;
}

// Coordinate of each command: -1 at the start of the range, 1 at its end.
std::vector<double> parts_of_range(const std::vector<double>& range) {
  std::vector<double> parts;
  const double middle = (range.front() + range.back()) / 2, half = range.back() - middle;
  for (const double x : range) parts.push_back(half > 0 ? (x - middle) / half : 0);
  return parts;
}

}  // namespace

Command GridPlan::command(std::size_t i, std::size_t j) const {
  Command command = others;
  command[first] = first_m[i];
  command[second] = second_m[j];
  return command;
}

void GridErrors::Chain::add(const Segment& next) {
  const bool joins = !segments.empty() &&
                     (next.varies == segments.back().varies || next.varies == Varies::nowhere ||
                      segments.back().varies == Varies::nowhere);
  if (!joins) {
    segments.push_back(next);
    return;
  }
  Segment& last = segments.back();
  if (last.varies == Varies::nowhere) {
    last.varies = next.varies;
    last.poses.resize(next.poses.size(), last.poses[0]);
  }
  for (std::size_t i = 0; i < last.poses.size(); ++i)
    last.poses[i] = next.poses[next.varies == Varies::nowhere ? 0 : i] * last.poses[i];
}

void GridErrors::Chain::begin_line(std::size_t j) {
  line = j;
  begin = tool;
  for (in_line = 0; in_line < segments.size() && segments[in_line].varies != Varies::with_first;
       ++in_line)
    begin = through(segments[in_line], 0, begin);
}

void GridErrors::begin_line(std::size_t j) {
  actual_.begin_line(j);
  nominal_.begin_line(j);
}

void GridErrors::add_frame(const MachineFrame& frame, const GridPlan& plan) {
  Segment actual, nominal;
  std::size_t count = 1;
  if (moves_along(frame, plan.first)) {
    actual.varies = Varies::with_first;
    count = plan.first_m.size();
  } else if (moves_along(frame, plan.second)) {
    actual.varies = Varies::with_second;
    count = plan.second_m.size();
  }
  nominal.varies = actual.varies;
  for (std::size_t i = 0; i < count; ++i) {
    const Command command = plan.command(actual.varies == Varies::with_first ? i : 0,
                                         actual.varies == Varies::with_second ? i : 0);
    const FrameValues values = values_at(frame, command, plan.approach);
    const Pose true_pose = actual_pose(frame, values), pose = nominal_pose(frame, values.travel);
    actual.poses.push_back(frame.carries_work ? true_pose.inverse() : true_pose);
    nominal.poses.push_back(frame.carries_work ? pose.inverse() : pose);
  }
  actual_.add(actual);
  nominal_.add(nominal);
}

GridErrors::GridErrors(const Machine& machine, const GridPlan& plan)
    : actual_{vector_of(machine.tool_m), {}, 0, 0, {}},
      nominal_{vector_of(machine.tool_m), {}, 0, 0, {}} {
  // Adds first the frames from the tool to the bed, then the frames from the bed to the work. In
  // Machine::frames the first frame is the frame next to the work.
  for (const bool of_work : {false, true})
    for (std::size_t i = machine.frames.size(); i-- > 0;)
      if (machine.frames[i].carries_work == of_work) add_frame(machine.frames[i], plan);
}

// Values of all frames, but only one group of frames keeps its uncertainties. of_first = true: the
// frames that move with the first axis; false: all other frames.
std::vector<FrameValues> GridVariances::values(const Command& command, bool of_first) const {
  auto all = values_at(machine_, command, plan_.approach);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (moves_along(machine_.frames[i], plan_.first) == of_first) continue;
    all[i].u_parts.setZero();
    all[i].u_location = {};
    all[i].shared.clear();
  }
  return all;
}

// Variance of the tool's place, without the parts that several frames have in common.
Eigen::Vector3d GridVariances::variance(const Command& command, bool of_first) const {
  auto alone = values(command, of_first);
  for (FrameValues& v : alone) v.shared.clear();
  return error_uncertainty(derivatives(machine_, command), alone).head<3>().cwiseAbs2();
}

std::vector<Vector6> GridVariances::shared(const Command& command, bool of_first) const {
  auto effects = shared_effects(derivatives(machine_, command), values(command, of_first));
  effects.resize(shared_, Vector6::Zero());
  return effects;
}

std::vector<GridVariances::Line> GridVariances::lines(Command command, std::size_t along,
                                                      const std::vector<double>& range,
                                                      bool of_first) const {
  std::vector<Line> all;
  if (shared_ == 0) return all;
  command[along] = range.front();
  const auto begin = shared(command, of_first);
  command[along] = range.back();
  const auto end = shared(command, of_first);
  for (std::size_t p = 0; p < shared_; ++p)
    all.push_back({(begin[p] + end[p]).head<3>() / 2, (end[p] - begin[p]).head<3>() / 2});
  return all;
}

GridVariances::Parabola GridVariances::parabola(Command command, std::size_t along,
                                                const std::vector<double>& range,
                                                bool of_first) const {
  const auto at = [&](double x) {
    command[along] = x;
    return variance(command, of_first);
  };
  const Eigen::Vector3d begin = at(range.front()), end = at(range.back());
  const Eigen::Vector3d middle = at((range.front() + range.back()) / 2);
  const double largest = begin.cwiseMax(middle).cwiseMax(end).maxCoeff();
  return {middle, (end - begin) / 2, (end + begin) / 2 - middle, kParabolaRounding * largest};
}

GridVariances::GridVariances(const Machine& machine, const GridPlan& plan)
    : machine_(machine),
      plan_(plan),
      first_part_(parts_of_range(plan.first_m)),
      second_part_(parts_of_range(plan.second_m)) {
  for (const MachineFrame& frame : machine.frames)
    shared_ = std::max(shared_, frame.covariance.shared.size());
  for (std::size_t i = 0; i < plan.first_m.size(); ++i) {
    first_axis_variances_.push_back(parabola(plan.command(i, 0), plan.second, plan.second_m, true));
    first_axis_shared_.push_back(lines(plan.command(i, 0), plan.second, plan.second_m, true));
  }
}

void GridVariances::begin_line(std::size_t j) {
  line_variance_ = parabola(plan_.command(0, j), plan_.first, plan_.first_m, false);
  line_shared_ = lines(plan_.command(0, j), plan_.first, plan_.first_m, false);
}

Eigen::Vector3d GridVariances::u_at(std::size_t i, std::size_t j) const {
  const Parabola& column = first_axis_variances_[i];
  Eigen::Vector3d sum = line_variance_.at(first_part_[i]) + column.at(second_part_[j]);
  for (std::size_t p = 0; p < shared_; ++p)
    sum += (line_shared_[p].at(first_part_[i]) + first_axis_shared_[i][p].at(second_part_[j]))
               .cwiseAbs2();
  const double rounding = line_variance_.rounding + column.rounding;
  Eigen::Vector3d u;
  for (Eigen::Index k = 0; k < 3; ++k) u[k] = sum[k] > rounding ? std::sqrt(sum[k]) : kNaN;
  return u;
}

}  // namespace mdof::algo
