#include "drivers/csv/positioning_csv.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "drivers/csv/csv_table.h"
#include "schema/base/number/number_text.h"
#include "schema/iso230/targets.h"
#include "schema/units.h"

namespace mdof::drivers {
namespace {

enum Column { kTarget, kDirection, kRun, kDeviation };
constexpr double kMostRuns = 1e6;
// Ratio of the distance of targets to the differences of actual positions.
constexpr double kTargetToScatter = 20;
constexpr double kMostScatter_m = 50e-6;  // positions that differ by more are other targets
constexpr const char* kDirectionValues =
    "1 if the target was approached in the + direction (forward), -1 if it was approached in the "
    "- direction";

// Index of the row for each combination of target, direction and run.
using Seen = std::map<std::tuple<double, int, int>, std::size_t>;

Result<PositioningReading> reading_of(const CsvTable& table, std::size_t row) {
  const auto at = [&](Column column) { return table.columns[column][row]; };
  const double direction = at(kDirection), run = at(kRun);
  if (direction != 1 && direction != -1)
    return bad_input(table.where(row) + "column direction: " + plain_number(direction) + "; give " +
                     kDirectionValues);
  if (run != std::floor(run) || !(std::abs(run) <= kMostRuns))
    return bad_input(table.where(row) + "column run: " + plain_number(run) +
                     "; use the run numbers 1, 2, 3 ...");
  return PositioningReading{from_mm(at(kTarget)), static_cast<int>(direction),
                            static_cast<int>(run), from_um(at(kDeviation))};
}

Status check_new(const CsvTable& table, std::size_t row, const PositioningReading& r, Seen& seen) {
  const auto [first, is_new] = seen.try_emplace({r.target_m, r.direction, r.run}, row);
  if (is_new) return {};
  return bad_input(table.where(row) + "the line has the same target, direction and run as line " +
                   std::to_string(table.header_line + 1 + first->second) +
                   "; give each run its own number (1, 2, 3 ...), or delete one of the two lines");
}

std::vector<double> targets_of(const CsvTable& table) {
  std::vector<double> positions_m;
  for (const double mm : table.columns[kTarget]) positions_m.push_back(from_mm(mm));
  return distinct_targets(std::move(positions_m));
}

// A reading in order of its position.
struct Place {
  double target_m = 0;
  std::size_t row = 0;
};

// Returns whether no two of these readings have the same direction and run: they then may be the
// readings of one target.
bool may_be_one_target(const std::vector<PositioningReading>& readings, const Place* begin,
                       const Place* end) {
  std::set<std::pair<int, int>> seen;
  return std::all_of(begin, end, [&](const Place& place) {
    return seen.emplace(readings[place.row].direction, readings[place.row].run).second;
  });
}

// Error: the targets are actual positions. They differ from run to run, by far less than the
// distance to the next target.
Status check_nominal(const CsvTable& table, const std::vector<PositioningReading>& readings) {
  std::vector<Place> places;
  for (std::size_t row = 0; row < readings.size(); ++row)
    places.push_back({readings[row].target_m, row});
  std::stable_sort(places.begin(), places.end(),
                   [](const Place& a, const Place& b) { return a.target_m < b.target_m; });
  std::vector<double> steps_m;
  for (std::size_t i = 1; i < places.size(); ++i)
    if (places[i].target_m > places[i - 1].target_m)
      steps_m.push_back(places[i].target_m - places[i - 1].target_m);
  std::sort(steps_m.begin(), steps_m.end());
  double within_m = 0, ratio = kTargetToScatter;
  for (std::size_t i = 1; i < steps_m.size(); ++i) {
    if (steps_m[i] < ratio * steps_m[i - 1]) continue;
    ratio = steps_m[i] / steps_m[i - 1];
    within_m = steps_m[i - 1];
  }
  const Place *first = nullptr, *last = nullptr;  // the group with the largest range
  for (std::size_t from = 0, to = 0; from < places.size(); from = to) {
    for (to = from + 1; to < places.size(); ++to)
      if (places[to].target_m - places[to - 1].target_m > within_m) break;
    if (!may_be_one_target(readings, &places[from], &places[from] + (to - from))) return {};
    const double range_m = places[to - 1].target_m - places[from].target_m;
    if (!first || range_m > last->target_m - first->target_m + 1e-3 * kSameTarget_m)
      first = &places[from], last = &places[to - 1];
  }
  if (within_m == 0 || !first || last->target_m - first->target_m > kMostScatter_m) return {};
  const auto line = [&](const Place& p) { return std::to_string(table.header_line + 1 + p.row); };
  return bad_input(table.where(first->row) + "column target_mm: the positions in the lines " +
                   line(*first) + " and " + line(*last) + " differ by " +
                   plain_number(to_um(last->target_m - first->target_m), 3) +
                   " um. Positions that differ by more than " + plain_number(to_um(kSameTarget_m)) +
                   " um are separate targets; give the nominal position as target_mm, which is the "
                   "same in all runs");
}

// If the direction is not a number, adds the valid values to the error.
Error with_remedy(Error error) {
  if (error.message.find(": column direction: \"") != std::string::npos)
    error.message += std::string("; the direction is ") + kDirectionValues;
  return error;
}

}  // namespace

Result<PositioningCsv> read_positioning_csv(const std::string& path, std::size_t most,
                                            int descriptor) {
  auto table =
      read_csv_table(path, {"target_mm", "direction", "run", "deviation_um"}, {}, most, descriptor);
  if (!table) return tl::unexpected(with_remedy(std::move(table.error())));
  PositioningCsv csv{table->source, table->simulated, {}};
  const std::vector<double> targets_m = targets_of(*table);
  Seen seen;
  for (std::size_t row = 0; row < table->rows(); ++row) {
    MDOF_TRY(PositioningReading reading, reading_of(*table, row));
    reading.target_m = targets_m[target_at(targets_m, reading.target_m)];
    MDOF_CHECK(check_new(*table, row, reading, seen));
    csv.readings.push_back(reading);
  }
  MDOF_CHECK(check_nominal(*table, csv.readings));
  return csv;
}

}  // namespace mdof::drivers
