#include "algo/machine/plane_map.h"

#include <algorithm>
#include <cmath>

namespace mdof::algo {
namespace {

constexpr std::size_t kMostPoints = 1'000'000;
constexpr std::string_view kAxes = "XYZ";

Result<const MachineFrame*> linear_axis(const Machine& machine, std::size_t direction) {
  const MachineFrame* frame = machine.find(kAxes.substr(direction, 1));
  if (frame) return frame;
  return bad_input("the chain " + machine.chain.text + " has no axis " +
                   std::string(kAxes.substr(direction, 1)) + "; ask for axes that it has");
}

}  // namespace

std::vector<double> steps_over(const std::array<double, 2>& range, double step_m) {
  const double count = std::max(1.0, std::round((range[1] - range[0]) / step_m));
  std::vector<double> at;
  for (double i = 0; i <= count; ++i) at.push_back(range[0] + (range[1] - range[0]) * i / count);
  return at;
}

Result<std::array<double, 2>> range_of(const MachineFrame& frame) {
  if (frame.range) return *frame.range;
  std::array<double, 2> range = {-INFINITY, INFINITY};
  for (const ErrorFunction& f : frame.error) {
    if (f.position.empty()) continue;
    range = {std::max(range[0], f.position.front()), std::min(range[1], f.position.back())};
  }
  if (range[0] < range[1] && std::isfinite(range[0])) return range;
  return bad_input("axis " + frame.id +
                   ": neither range_mm nor tables that have positions in common; add range_mm = "
                   "[from, to] to its [[axis]]");
}

Machine without_angles(Machine machine) {
  for (MachineFrame& frame : machine.frames)
    for (std::size_t k = 3; k < kBodyErrors; ++k) frame.error[k] = {{}, {0}, {}, {0}, {}};
  return machine;
}

Result<PlaneMap> plane_map(const Machine& machine, const PlaneMapRequest& request) {
  MDOF_TRY(const MachineFrame* first, linear_axis(machine, request.first));
  MDOF_TRY(const MachineFrame* second, linear_axis(machine, request.second));
  MDOF_TRY(const auto first_range, range_of(*first));
  MDOF_TRY(const auto second_range, range_of(*second));
  const auto count = [&](const std::array<double, 2>& r) {
    return (r[1] - r[0]) / request.step_m + 2;
  };
  if (!(count(first_range) * count(second_range) < static_cast<double>(kMostPoints)))
    return bad_input("a map of a million points or more; take a larger step");
  PlaneMap map{request.first,
               request.second,
               steps_over(first_range, request.step_m),
               steps_over(second_range, request.step_m),
               {},
               {},
               {},
               {}};
  const Machine chosen = request.without_angles ? without_angles(machine) : machine;
  Command command = request.others;
  for (const double b : map.second_m) {
    for (const double a : map.first_m) {
      command[request.first] = a;
      command[request.second] = b;
      const ToolError e = tool_error(chosen, command, request.approach);
      map.points.push_back({a, b, e.exact, e.u});
      for (std::size_t k = 0; k < 3; ++k) {
        add_new(e.not_measured[k], map.not_measured);
        add_new(e.no_u[k], map.no_u);
      }
      add_new(e.beyond, map.beyond);
    }
  }
  return map;
}

MapExtreme extreme_of(const PlaneMap& map, std::size_t component) {
  const auto k = static_cast<Eigen::Index>(component);
  MapExtreme extreme;
  double low = INFINITY, high = -INFINITY;
  for (std::size_t i = 0; i < map.points.size(); ++i) {
    const double e = map.points[i].error[k];
    low = std::min(low, e);
    high = std::max(high, e);
    if (i == 0 || std::abs(e) > std::abs(extreme.value)) extreme = {i, e, 0};
  }
  extreme.range = high - low;
  return extreme;
}

}  // namespace mdof::algo
