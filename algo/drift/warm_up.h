// Decides whether a system has warmed up, from readings of a parked axis: the drift rate of each
// series in equal windows of time, and the time from which all rates stay below a limit.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace mdof::algo {

// One value for each step; NaN: no reading.
struct ParkedSeries {
  std::string name;  // "A_um", "EYX_um"
  std::vector<double> value;
  double limit_per_s = std::numeric_limits<double>::infinity();  // infinity: no limit
};

struct ParkedReadings {
  double step_s = 0;                  // time between values; each value is a mean over it
  std::vector<ParkedSeries> series;   // SI, all of the same length
  std::vector<double> temperature_C;  // same length; empty: no temperature
};

// `undecided`: the limit is within two standard uncertainties. `unknown`: too few readings, or the
// value is constant over the whole log: a dead probe, or a resolution that hides the drift.
enum class DriftVerdict { below, above, undecided, unknown };
const char* to_string(DriftVerdict verdict);

struct DriftWindow {
  double rate_per_s = 0, u_rate_per_s = 0;  // NaN: unknown
  DriftVerdict verdict = DriftVerdict::unknown;
};

struct WithTemperature {
  double slope_per_K = 0, correlation = 0;  // NaN: temperature or reading is constant
};

struct WarmUp {
  std::vector<double> begin_s;  // start of each window since the first reading
  double window_s = 0;
  std::vector<std::vector<DriftWindow>> windows;  // [series][window]
  std::vector<WithTemperature> with_temperature;  // [series]; empty: no temperature
  bool limited = false;                           // whether any series has a limit
  // From this time on every window of every series with a limit is below its limit; these are at
  // least kFewestBelow windows and last at least kShortestBelow_s in total. Empty: not ready, or no
  // limit.
  std::optional<double> ready_after_s;
};

inline constexpr std::size_t kFewestBelow = 3, kStepsOfWindow = 10, kFewestSteps = 6;
inline constexpr double kShortestBelow_s = 600;  // thermal drift has time constants of minutes

// Consecutive windows of kStepsOfWindow steps; an incomplete last window is left out. A rate is the
// slope of the least-squares line through the readings of a window, its u is from their scatter
// about the line. A window with fewer than kFewestSteps readings has no rate.
WarmUp warm_up(const ParkedReadings& readings);

}  // namespace mdof::algo
