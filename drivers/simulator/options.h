// Options of the simulated axis. The units and names are those of the configuration keys.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "schema/base/result.h"
#include "schema/base/toml/toml_reader.h"
#include "schema/rig/rig.h"

namespace mdof::drivers {

// One error of the moving body with its name in ISO 230-1, at the position d of the axis:
// E(d) = amplitude sin(2π (d / period + phase)) + slope d ± reversal / 2
// The sign is + while the axis moves forward and - while it moves back: E_forward - E_reverse =
// reversal. Unit: µm for a linear error, µrad for an angle.
struct NamedError {
  std::string name;         // key `name`: "EYX"
  double amplitude = 0;     // keys amplitude_um, amplitude_urad
  double period_mm = 50;    // key period_mm
  double phase_turns = 0;   // key phase_turns
  double slope_per_mm = 0;  // keys slope_um_per_mm, slope_urad_per_mm
  double reversal = 0;      // keys reversal_um, reversal_urad
};

// Time is divided into windows of length_s. `probability` is the probability that a window is
// faulty; the fault lasts for the whole window.
struct Bursts {
  double probability = 0;
  double length_s = 0.05;
};

struct Interval {
  double from_s = 0, to_s = 0;  // time since the first open()

  std::int64_t from_ns() const { return static_cast<std::int64_t>(from_s * 1e9); }
  std::int64_t to_ns() const { return static_cast<std::int64_t>(to_s * 1e9); }
  bool holds(std::int64_t t_ns) const { return t_ns >= from_ns() && t_ns < to_ns(); }
};

struct LostProbe {
  std::string probe;
  Interval when;
};

struct SimulatorOptions {
  double rate_hz = 1000;
  double packet_ms = 2;   // each packet contains the scans of this time, as from a real device
  bool real_time = true;  // key pace = "real-time": scans arrive in real time; "fast": at once
  bool loop = true;       // after the last repeat, true: begins again; false: ends
  std::int64_t seed = 1;

  // ascending; default: calculated from the keys from, to, interval and jitter.
  std::vector<double> targets_mm;
  // Travel beyond the first and the last target, so that every target is approached from both
  // directions.
  double overrun_mm = 2;
  int repeats = 5;  // number of cycles, forward and back
  double dwell_s = 0.5;
  double speed_mm_s = 20;  // highest speed of a move
  double acceleration_mm_s2 = 200;
  double settle_um = 0;  // overshoot at arrival; it decays within settle_s
  double settle_hz = 25;
  double settle_s = 0.1;

  // Default: the errors of a plausible small machine. If the configuration names errors, only these
  // errors exist.
  std::vector<NamedError> errors;
  double noise_um = 0.01;  // standard deviation, for each probe
  double encoder_noise_nm = 5;
  double encoder_resolution_nm = 10;  // 0: the position is not rounded

  double spike_probability = 0;  // probability for each value of each probe
  double spike_um = 20;
  Bursts saturation;  // key [saturation]: windows in which a probe is at the end of its range
  Bursts gap;         // key [gap]: windows whose scans are never sent
  std::vector<LostProbe> lost;  // key [[lost]]: times at which a probe has no values
  // Key [[disconnect]]: times at which the device is disconnected.
  std::vector<Interval> disconnects;
};

// Reads all keys of the simulator and rejects unknown keys; the caller must have read its own keys
// before. Errors name file, line and key.
Status read_options(TomlTable& table, SimulatorOptions& options);

// Checks the options against the rig (errors of another axis, unknown or repeated names) and
// completes the options: default targets, and five errors in the order of error_names().
Status fit_to_rig(SimulatorOptions& options, const Rig& rig);

}  // namespace mdof::drivers
