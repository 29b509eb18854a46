// Determines from readings of a parked axis whether a system has warmed up. Calculates the drift
// rate of each series in equal windows of time, and the time after which all rates stay below their
// limits.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace mdof::algo {

// One series of readings; `value` has one value for each time step, NaN: no reading.
struct ParkedSeries {
  std::string name;  // "A_um", "EYX_um"
  std::vector<double> value;
  double limit_per_s = std::numeric_limits<double>::infinity();  // infinity: no limit
};

struct ParkedReadings {
  double step_s = 0;                  // time between values; each value is the mean over this time
  std::vector<ParkedSeries> series;   // SI units; all series have the same length
  std::vector<double> temperature_C;  // same length; empty: no temperature
};

// `undecided`: the difference between rate and limit is less than two standard uncertainties.
// `unknown`: there are too few readings, or the value is constant over the whole log (the probe is
// dead, or its resolution is too coarse).
enum class DriftVerdict { below, above, undecided, unknown };
const char* to_string(DriftVerdict verdict);

struct DriftWindow {
  double rate_per_s = 0, u_rate_per_s = 0;  // NaN: unknown
  DriftVerdict verdict = DriftVerdict::unknown;
};

struct TemperatureDependence {
  double slope_per_K = 0, correlation = 0;  // NaN: temperature or reading is constant
};

struct WarmUp {
  std::vector<double> begin_s;  // start of each window; time since the first reading
  double window_s = 0;
  std::vector<std::vector<DriftWindow>> windows;        // [series][window]
  std::vector<TemperatureDependence> with_temperature;  // [series]; empty: no temperature
  bool limited = false;                                 // whether any series has a limit
  // After this time, the rates of all series with a limit are below their limits in all windows.
  // There are at least kFewestBelow such windows, with a total length of at least kShortestBelow_s.
  // Empty: not ready, or no limit.
  std::optional<double> ready_after_s;
};

inline constexpr std::size_t kFewestBelow = 3, kStepsOfWindow = 10, kFewestSteps = 6;
inline constexpr double kShortestBelow_s = 600;  // thermal drift has time constants of minutes

// The windows are consecutive and have kStepsOfWindow time steps; an incomplete last window is left
// out. The rate is the slope of the least-squares line through the readings of a window. u of the
// rate is calculated from the scatter of the readings about the line. A window with fewer than
// kFewestSteps readings has no rate.
WarmUp warm_up(const ParkedReadings& readings);

}  // namespace mdof::algo
