// Options of the simulated axis, with the units and names of their configuration keys.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "schema/base/result.h"
#include "schema/base/toml/toml_reader.h"
#include "schema/rig/rig.h"

namespace mdof::drivers {

// One named error (ISO 230-1) against the travel d; `um` is µm for a straightness and µrad for an
// angle:
//   E(d) = amplitude sin(2π (d / period + phase)) + slope d ± reversal / 2
// + while the axis moves forward, - in reverse: E_forward - E_reverse = reversal.
struct NamedError {
  std::string name;         // "EYX"; key `name`
  double amplitude = 0;     // amplitude_um, amplitude_urad
  double period_mm = 50;    // period_mm
  double phase_turns = 0;   // phase_turns
  double slope_per_mm = 0;  // slope_um_per_mm, slope_urad_per_mm
  double reversal = 0;      // reversal_um, reversal_urad
};

// Time is divided into windows of length_s. Each window is faulty as a whole, with this
// probability.
struct Bursts {
  double probability = 0;
  double length_s = 0.05;
};

struct Interval {
  double from_s = 0, to_s = 0;  // since the first open()

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
  double packet_ms = 2;   // scans arrive in packets of this length, as from a real device
  bool real_time = true;  // pace = "real-time": scans arrive in real time; "fast": at once
  bool loop = true;       // after the last repeat: true: begin again; false: end
  std::int64_t seed = 1;

  std::vector<double> targets_mm;  // ascending; by default made of from, to, interval and jitter
  // Beyond both ends, so that every target is approached from both directions.
  double overrun_mm = 2;
  int repeats = 5;  // forward and back
  double dwell_s = 0.5;
  double speed_mm_s = 20;  // highest speed of a move
  double acceleration_mm_s2 = 200;
  double settle_um = 0;  // overshoot at arrival; decays within settle_s
  double settle_hz = 25;
  double settle_s = 0.1;

  // Default: those of a plausible small machine; if some are named, only these.
  std::vector<NamedError> errors;
  double noise_um = 0.01;  // standard deviation, each probe
  double encoder_noise_nm = 5;
  double encoder_resolution_nm = 10;  // 0: not rounded

  double spike_probability = 0;  // for each value of each probe
  double spike_um = 20;
  Bursts saturation;            // windows in which a probe is at the end of its range; [saturation]
  Bursts gap;                   // windows whose scans are never sent; [gap]
  std::vector<LostProbe> lost;  // times without values of a probe; [[lost]]
  std::vector<Interval> disconnects;  // times at which the device is gone; [[disconnect]]
};

// Reads all keys of the simulator, then calls table.finish(); the caller must have read its own
// keys before. Errors name file, line and key.
Status read_options(TomlTable& table, SimulatorOptions& options);

// Checks the options against the rig (errors of another axis, unknown or repeated names) and
// completes them: default targets; five errors, in the order of error_names().
Status fit_to_rig(SimulatorOptions& options, const Rig& rig);

}  // namespace mdof::drivers
