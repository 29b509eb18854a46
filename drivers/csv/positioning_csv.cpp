#include "drivers/csv/positioning_csv.h"

#include <cmath>
#include <map>
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
  return csv;
}

}  // namespace mdof::drivers
