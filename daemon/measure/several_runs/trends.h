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
#include "schema/uncertainty/covers.h"
#include "schema/uncertainty/noise_only.h"

namespace mdof::daemon {

struct TrendRequest {
  std::optional<Axis> axis;  // all figures of its runs; none: EC0Y, and those of every axis
  std::string figure;        // only this one: "EYX_straightness_um", "EC0Y_urad"; empty: all
  std::size_t baseline = 0;  // as of algo::control_chart()
  bool mixed = false;        // take the runs of other rigs and models as well
};

struct TrendValue {
  std::vector<std::int64_t> runs;  // one, or the two of a squareness
  std::string started_utc;         // of the last of them
  // SI. u: combined, NaN where it cannot be made; u_random: of it noise and repeatability, by which
  // the chart judges, for what rigs declare is alike in all runs.
  double value = 0, u = 0, u_random = 0;
};
struct Trend {
  std::string figure;
  std::size_t baseline = 0;           // as it was asked for
  std::vector<TrendValue> values;     // in time
  std::optional<algo::Chart> chart;   // none: too few values
  std::vector<std::string> left_out;  // sentences: which runs, and why
  Notices notices;                    // what is mixed
  // Of u of the newest value, as of its budget.
  Covers u_covers;
  NoiseOnly noise_only = NoiseOnly::none;  // of all values
  std::vector<std::string> u_not_declared;
};

// At the fixture. Complete, measured runs that nothing supersedes, of one recording the newest, of
// the rig and model of the newest of them; what else there is, is named. Errors: no such figure.
Result<std::vector<Trend>> trends(store::Store& store, const TrendRequest& request);

}  // namespace mdof::daemon
