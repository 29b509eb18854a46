#include "algo/compensation/imported_table.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "schema/base/number/number_text.h"
#include "schema/iso230/targets.h"
#include "schema/recording/run_options.h"
#include "schema/sample.h"
#include "schema/units.h"

namespace mdof::algo {
namespace {

std::vector<double> targets_of(const Run& run) {
  std::vector<double> positions;
  for (const MeasuredPoint& p : run.points) positions.push_back(p.target_m);
  return distinct_targets(std::move(positions));
}

std::string name_of(const Run& run) {
  return "run " + std::to_string(run.header.id);
}

Status check_one(const Run& run, const Run& first) {
  const Axis axis = first.header.axis;
  if (!is_imported(run.header))
    return bad_input(name_of(run) + " was measured by mdof and " + name_of(first) +
                     " is imported; build a separate table from each");
  const std::string& error = run.header.provenance.model;
  if (run.header.axis != axis)
    return bad_input(name_of(run) + " measures axis " + letter(run.header.axis) + ", but " +
                     name_of(first) + " measures axis " + letter(axis) +
                     "; build a table from runs of one axis");
  if (error != positioning_name(axis))
    return bad_input(name_of(run) + " contains the imported error " + error +
                     ", whose reference point is unknown; from imported runs, mdof builds tables "
                     "of the positioning error only (" +
                     positioning_name(axis) + ")");
  if (run.header.simulated != first.header.simulated)
    return bad_input(name_of(run.header.simulated ? run : first) + " is simulated and " +
                     name_of(run.header.simulated ? first : run) +
                     " is measured; build a table from only simulated or only measured runs");
  return {};
}

Status check_sources(const std::vector<Run>& runs) {
  for (std::size_t i = 0; i < runs.size(); ++i) {
    MDOF_CHECK(check_one(runs[i], runs.front()));
    for (std::size_t j = 0; j < i; ++j)
      if (runs[i].header.provenance.recording_sha256 == runs[j].header.provenance.recording_sha256)
        return bad_input(name_of(runs[j]) + " and " + name_of(runs[i]) +
                         " were imported from the same file, and readings that count twice make "
                         "the uncertainty too small; leave one run out");
  }
  return {};
}

// Returns the factor +1 or -1 for the readings of each run.
Result<std::vector<double>> signs_of(const std::vector<Run>& runs,
                                     std::optional<bool> against_command) {
  std::vector<double> signs;
  for (const Run& run : runs) {
    MDOF_TRY(const double sign, command_sign(run.header, against_command));
    signs.push_back(sign);
  }
  return signs;
}

// Readings of one approach at each target of the grid.
Result<std::vector<std::vector<double>>> readings_of(const std::vector<Run>& runs,
                                                     const std::vector<double>& signs,
                                                     const std::vector<double>& grid,
                                                     int direction) {
  std::vector<std::vector<double>> at(grid.size());
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const Run& run = runs[r];
    for (const MeasuredPoint& p : run.points) {
      const std::size_t i = target_at(grid, p.target_m);
      if (std::abs(grid[i] - p.target_m) > kSameTarget_m)
        return bad_input(
            name_of(run) + " has a target at " + plain_number(to_mm(p.target_m), 9) + " mm, but " +
            name_of(runs.front()) +
            " has no target at this position; build a table from runs with the same targets");
      if (p.point.direction == direction || p.point.direction == 0)
        at[i].push_back(signs[r] * p.point.probe_m.at(0));
    }
  }
  return at;
}

double mean_of(const std::vector<double>& x) {
  double sum = 0;
  for (const double v : x) sum += v;
  return x.empty() ? kNaN : sum / static_cast<double>(x.size());
}

// Standard uncertainty of the mean. NaN if there is one reading, or if all readings are equal:
// their scatter is then smaller than the resolution of the instrument, which is unknown.
double u_of_mean(const std::vector<double>& x) {
  if (x.size() < 2) return kNaN;
  const auto [low, high] = std::minmax_element(x.begin(), x.end());
  if (*low == *high) return kNaN;
  const double mean = mean_of(x), n = static_cast<double>(x.size());
  double squares = 0;
  for (const double v : x) squares += (v - mean) * (v - mean);
  return std::sqrt(squares / (n - 1) / n);
}

// Whether u_of_mean() is unknown at a target.
bool lacks_repeatability(const std::vector<Run>& runs) {
  const std::vector<double> grid = targets_of(runs.front());
  std::map<std::pair<std::size_t, int>, std::vector<double>> readings;
  for (const Run& run : runs)
    for (const MeasuredPoint& p : run.points)
      readings[{target_at(grid, p.target_m), p.point.direction}].push_back(p.point.probe_m.at(0));
  return std::any_of(readings.begin(), readings.end(),
                     [](const auto& of) { return std::isnan(u_of_mean(of.second)); });
}

// Returns the largest declared u; NaN if a run declares no uncertainty.
double declared_of(const std::vector<Run>& runs) {
  double largest = 0;
  for (const Run& run : runs)
    for (const MeasuredPoint& p : run.points) {
      if (p.point.probe_u_m.empty()) return kNaN;
      largest = std::max(largest, p.point.probe_u_m.front());
    }
  return largest;
}

void set_declared(CompensationTable& table, double u) {
  if (std::isnan(u)) return;
  const std::size_t n = table.position_m.size();
  table.u_declared.fill(std::vector<double>(n, kNaN));
  table.positioning.u_declared.assign(n, u);
}

}  // namespace

std::vector<double> imported_targets(const std::vector<ImportedReading>& readings) {
  std::vector<double> positions;
  for (const ImportedReading& r : readings) positions.push_back(r.position_m);
  return distinct_targets(std::move(positions));
}

Result<double> command_sign(const RunHeader& run, std::optional<bool> against_command) {
  if (against_command) MDOF_CHECK(check_travel(run, *against_command));
  const ImportedSense stated = run_options(run).imported;
  const std::optional<bool> against =
      stated.against_command ? stated.against_command : against_command;
  if (stated.sense == PositioningSense::body && !against)
    return bad_input("run " + std::to_string(run.id) +
                     " was imported with the sense \"body\", but without the travel direction of "
                     "the axis (\"+\" or \"-\"), so the sign of the error relative to the command "
                     "is unknown; import the file again with the travel direction");
  return stated.sense == PositioningSense::body && *against ? -1 : 1;
}

Status check_travel(const RunHeader& run, bool against_command) {
  const auto stated = run_options(run).imported.against_command;
  if (!stated || *stated == against_command) return {};
  return bad_input("run " + std::to_string(run.id) + " was imported with travel \"" +
                   (*stated ? "-" : "+") + "\", but the machine file states travel \"" +
                   (*stated ? "+" : "-") + "\" for axis " + letter(run.axis) +
                   "; correct the machine file, or import the file again");
}

Result<CompensationTable> build_positioning_table(const std::vector<Run>& runs,
                                                  std::optional<bool> against_command) {
  if (runs.empty()) return bad_input("a compensation table needs at least one run");
  MDOF_CHECK(check_sources(runs));
  CompensationTable table;
  table.axis = runs.front().header.axis;
  table.slope_removed = false;
  table.position_m = targets_of(runs.front());
  const std::size_t n = table.position_m.size();
  if (n < 2)
    return bad_input(name_of(runs.front()) + " has one target; a table needs at least two");
  for (const Run& run : runs) {
    table.runs.push_back(run.header.id);
    table.simulated = table.simulated || run.header.simulated;
  }
  for (auto* group : {&table.forward, &table.reverse, &table.u_forward, &table.u_reverse})
    group->fill(std::vector<double>(n, kNaN));
  MDOF_TRY(const auto signs, signs_of(runs, against_command));
  MDOF_TRY(const auto forward, readings_of(runs, signs, table.position_m, 1));
  MDOF_TRY(const auto reverse, readings_of(runs, signs, table.position_m, -1));
  PositioningErrors& along = table.positioning;
  for (std::size_t i = 0; i < n; ++i) {
    along.forward.push_back(mean_of(forward[i]));
    along.reverse.push_back(mean_of(reverse[i]));
    along.u_forward.push_back(u_of_mean(forward[i]));
    along.u_reverse.push_back(u_of_mean(reverse[i]));
  }
  set_declared(table, declared_of(runs));
  return table;
}

Notices positioning_notices(const std::vector<Run>& runs) {
  Notices notices;
  for (const Run& run : runs) {
    const bool unknown = std::any_of(run.points.begin(), run.points.end(),
                                     [](const auto& p) { return p.point.direction == 0; });
    if (unknown)
      notices.push_back(inherited(name_of(run), notice(NoticeCode::approach_not_stated)));
  }
  if (lacks_repeatability(runs)) notices.push_back(notice(NoticeCode::single_readings));
  return notices;
}

}  // namespace mdof::algo
