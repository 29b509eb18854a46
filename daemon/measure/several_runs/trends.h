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
  std::optional<Axis> axis;  // all figures of the runs of this axis; nullopt: EC0Y and the figures
                             // of every axis
  std::string figure;  // the only wanted figure: "EYX_straightness_um", "EC0Y_urad"; empty: all
  std::size_t baseline = 0;  // as in algo::control_chart()
  bool mixed = false;        // also use runs of other rigs and models
};

struct TrendValue {
  std::vector<std::int64_t> runs;  // one, or two for a squareness
  std::string started_utc;         // start of the last run
  // Without its lines. u, U and k are NaN if u cannot be calculated. The chart uses u_random, the
  // part of noise and repeatability, because declared uncertainties are the same in all runs.
  Budget stated;
};
struct Trend {
  std::string figure;
  std::size_t baseline = 0;           // as requested
  std::vector<TrendValue> values;     // values in order of time
  std::optional<algo::Chart> chart;   // nullopt: too few values
  std::vector<std::string> left_out;  // sentences: the runs that were left out, with the reason
  Notices notices;                    // notices on mixed rigs and models
  // Contributions to u, from the budget of the newest value with noise only, otherwise of the
  // first.
  Covers u_covers;
  NoiseOnly noise_only = NoiseOnly::none;  // common value for all values of the trend
  std::vector<std::string> u_not_declared;
};

// Values are at the fixture. Uses complete, measured runs that are not superseded: the newest run
// of each recording, with the rig and model of the newest such run. Other runs are listed in
// left_out. Errors: unknown figure.
Result<std::vector<Trend>> trends(store::Store& store, const TrendRequest& request);

}  // namespace mdof::daemon
