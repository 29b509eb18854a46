// Figures of the stored runs over time, for control charts.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "algo/trend/control_chart.h"
#include "daemon/store/store.h"
#include "schema/axis.h"
#include "schema/base/result.h"
#include "schema/notice/notice.h"
#include "schema/uncertainty/budget.h"
#include "schema/uncertainty/covers.h"
#include "schema/uncertainty/noise_only.h"

namespace mdof::daemon {

struct TrendRequest {
  // Figures of the runs of this axis; nullopt: figures of all axes, and the squareness.
  std::optional<Axis> axis;
  // Name of the only requested figure: "EYX_straightness_um", "EC0Y_urad"; empty: all figures.
  std::string figure;
  // Number of first values that determine the limits of the chart. 0: all values except the last.
  std::size_t baseline = 0;
  bool mixed = false;                 // also use runs with other rigs, models or options
  std::vector<std::int64_t> without;  // runs that are not used
};

struct TrendValue {
  std::vector<std::int64_t> runs;  // one run; two runs for a squareness
  std::string started_utc;         // start of the later run
  // Budget of the value, without the contributors (budget lines). If u cannot be calculated, u, U
  // and k are NaN. The chart uses only u_random (noise and repeatability), because the declared
  // uncertainties are the same in all runs.
  Budget stated;
};
struct Trend {
  std::string figure;
  std::size_t baseline = 0;           // as in TrendRequest
  std::vector<TrendValue> values;     // values, in the order of time
  std::optional<algo::Chart> chart;   // nullopt: there are too few values for a chart
  std::vector<std::string> left_out;  // sentences: the runs that were left out, with the reason
  Notices notices;                    // notices that the runs have different rigs or models
  // Contributions to u, from the budget of the last value whose u contains noise only; if there is
  // no such value, from the budget of the first value.
  Covers u_covers;
  NoiseOnly noise_only = NoiseOnly::none;  // summary for all values of the trend
  std::vector<std::string> u_not_declared;
};

// Calculates the trends. The reference point of all values is the fixture. A run is used if it is
// complete, measured, valid and not simulated, if no other run supersedes it, and if it is the
// newest run of its recording. Unless `mixed` is set, all runs have the rig of the newest run, and
// the same model and options. `left_out` lists the other runs. Error: the figure is unknown.
Result<std::vector<Trend>> trends(store::Store& store, const TrendRequest& request);

}  // namespace mdof::daemon
