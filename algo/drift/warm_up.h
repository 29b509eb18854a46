// Has a system warmed up? Of readings of a parked axis: how fast each drifts in equal stretches of
// time, and since when all of them stay below a limit.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace mdof::algo {

// One reading a step; NaN: there was none.
struct ParkedSeries {
  std::string name;  // "A_um", "EYX_um"
  std::vector<double> value;
  double limit_per_s = std::numeric_limits<double>::infinity();  // infinity: it has none
};

struct ParkedReadings {
  double step_s = 0;                  // from one reading to the next, means over it
  std::vector<ParkedSeries> series;   // SI, all of the same length
  std::vector<double> temperature_C;  // likewise, or empty: nobody read it
};

// `undecided`: the limit lies within two standard uncertainties. `unknown`: too few readings, or
// the reading of the whole log never changes: of a dead probe, or of one whose step hides the
// drift.
enum class DriftVerdict { below, above, undecided, unknown };
const char* to_string(DriftVerdict verdict);

struct DriftWindow {
  double rate_per_s = 0, u_rate_per_s = 0;  // NaN: unknown
  DriftVerdict verdict = DriftVerdict::unknown;
};

struct WithTemperature {
  double slope_per_K = 0, correlation = 0;  // NaN: the temperature, or the reading, does not change
};

struct WarmUp {
  std::vector<double> begin_s;  // of each window, from the first reading on
  double window_s = 0;
  std::vector<std::vector<DriftWindow>> windows;  // [series][window]
  std::vector<WithTemperature> with_temperature;  // [series]; empty: no temperature
  bool limited = false;                           // any series has a limit
  // From then on every window of every series with a limit is below it, and there are at least
  // kFewestBelow of them, which last kShortestBelow_s. None: not ready, or not limited.
  std::optional<double> ready_after_s;
};

inline constexpr std::size_t kFewestBelow = 3, kStepsOfWindow = 10, kFewestSteps = 6;
inline constexpr double kShortestBelow_s = 600;  // thermal drift has time constants of minutes

// Windows of kStepsOfWindow steps, one after the other; the last steps that fill none are left out.
// A rate is the slope of the least-squares line through a window's readings, its u by their scatter
// about the line. Fewer than kFewestSteps readings in a window give none.
WarmUp warm_up(const ParkedReadings& readings);

}  // namespace mdof::algo
