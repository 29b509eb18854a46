#include "algo/machine/plane_map.h"

#include <algorithm>
#include <cmath>

#include "algo/machine/grid_chain.h"

namespace mdof::algo {
namespace {

constexpr std::size_t kMostPoints = 1'000'000;
constexpr std::string_view kAxes = "XYZ";

Result<const MachineFrame*> linear_axis(const Machine& machine, std::size_t direction) {
  const MachineFrame* frame = machine.find(kAxes.substr(direction, 1));
  if (frame) return frame;
  return bad_input("the chain " + machine.chain.text + " has no axis " +
                   std::string(kAxes.substr(direction, 1)) + "; use only axes of this chain");
}

void add_points(const Machine& machine, const PlaneMapRequest& request, PlaneMap& map) {
  const GridPlan plan{request.first, request.second, map.first_m,
                      map.second_m,  request.others, request.approach};
  GridErrors errors(machine, plan);
  GridVariances variances(machine, plan);
  MapExtremes extremes;
  if (!request.extremes_only) map.points.reserve(map.first_m.size() * map.second_m.size());
  for (std::size_t j = 0; j < map.second_m.size(); ++j) {
    errors.begin_line(j);
    variances.begin_line(j);
    for (std::size_t i = 0; i < map.first_m.size(); ++i) {
      const PlanePoint point{errors.at(i), variances.u_at(i, j)};
      extremes.add(point);
      if (!request.extremes_only) map.points.push_back(point);
    }
  }
  map.extremes = extremes.found();
}

// Collects names at the four corners only. This is sufficient for derivatives: they are linear in
// the commands of the two axes, so a derivative that is 0 at all corners is 0 everywhere. The
// corners are also sufficient for commands beyond a table, because they have the smallest and
// largest commands.
void add_names(const Machine& machine, const PlaneMapRequest& request, PlaneMap& map) {
  Command command = request.others;
  for (const double b : {map.second_m.front(), map.second_m.back()})
    for (const double a : {map.first_m.front(), map.first_m.back()}) {
      command[request.first] = a;
      command[request.second] = b;
      const ToolError e = tool_error(machine, command, request.approach);
      for (std::size_t k = 0; k < 3; ++k) {
        add_new(e.not_measured[k], map.not_measured);
        add_new(e.no_u[k], map.no_u);
      }
      add_new(e.beyond, map.beyond);
    }
}

}  // namespace

std::vector<double> steps_over(const std::array<double, 2>& range, double step_m) {
  const double count = std::max(1.0, std::round((range[1] - range[0]) / step_m));
  std::vector<double> at;
  for (double i = 0; i <= count; ++i) at.push_back(range[0] + (range[1] - range[0]) * i / count);
  at.back() = range[1];  // exactly the end of the range, without rounding
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
                   " has neither range_mm nor error tables with a common range; add range_mm = "
                   "[from, to] to the [[axis]] table of this axis");
}

Machine without_angles(Machine machine) {
  for (MachineFrame& frame : machine.frames)
    for (std::size_t k = 3; k < kBodyErrors; ++k) {
      frame.error[k] = {{}, {0}, {}, {0}, {}};
      for (auto* by_position : {&frame.covariance.noise, &frame.covariance.declared})
        for (Covariance6& at : *by_position)
          for (std::size_t l = 0; l < kBodyErrors; ++l) at[k][l] = at[l][k] = 0;
      for (SharedPart& part : frame.covariance.shared)
        for (auto& at : part.at) at[k] = 0;
    }
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
    return bad_input("the map would have a million points or more; use a larger step");
  PlaneMap map{request.first,
               request.second,
               steps_over(first_range, request.step_m),
               steps_over(second_range, request.step_m),
               {},
               {},
               {},
               {},
               {}};
  const Machine chosen = request.without_angles ? without_angles(machine) : machine;
  add_points(chosen, request, map);
  add_names(chosen, request, map);
  return map;
}

void MapExtremes::add(const PlanePoint& point) {
  for (std::size_t k = 0; k < 3; ++k) {
    const auto of = static_cast<Eigen::Index>(k);
    const double e = point.error[of];
    if (e < ends_[k].lowest.value) ends_[k].lowest = {points_, e, point.u[of], 0};
    if (e > ends_[k].highest.value) ends_[k].highest = {points_, e, point.u[of], 0};
  }
  ++points_;
}

std::array<MapExtreme, 3> MapExtremes::found() const {
  std::array<MapExtreme, 3> extremes;
  for (std::size_t k = 0; k < 3; ++k) {
    const MapExtreme &low = ends_[k].lowest, &high = ends_[k].highest;
    const double low_size = std::abs(low.value), high_size = std::abs(high.value);
    const bool is_low = low_size == high_size ? low.point < high.point : low_size > high_size;
    extremes[k] = is_low ? low : high;
    extremes[k].range = high.value - low.value;
  }
  return extremes;
}

}  // namespace mdof::algo
