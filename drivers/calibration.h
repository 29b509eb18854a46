// Raw numbers of a device -> metres of displacement, with the quality each value has earned. The
// last step of every driver; nothing after it knows volts or gaps.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "schema/base/result.h"
#include "schema/notice/notice.h"
#include "schema/rig/rig.h"
#include "schema/sample.h"

namespace mdof::drivers {

// Displacement along `measures` in m for a raw reading in µm (schema/rig/rig.h, Calibration).
double displacement_m(const Calibration& calibration, double raw_um);

// Displacements along `measures` in m between which a reading of the probe is not at the end of its
// range, the lower one first.
std::array<double, 2> displacement_window_m(const Probe& probe);

// One for each probe of these channels whose calibration record states um_per_V and that gives a
// length: its sensitivity is then that of the amplifier, and u is that of the record.
Notices unused_scales(const Rig& rig, const std::vector<Channel>& channels);

// Reentrant; holds a copy of what it needs of the rig.
class Calibrator {
 public:
  explicit Calibrator(const Rig& rig);

  // Turns the probes and the encoder of `block` into Unit::metre, in place. A reading at the end of
  // its probe's range (within 0.05 % of it) becomes Quality::over_range, a NaN Quality::missing.
  // Channels the rig does not know are left as they are. Error: volts without um_per_V, a probe or
  // the encoder in a unit that is no length.
  Status apply(SampleBlock& block) const;
  // The same error for a device with these channels, before it gives anything.
  Status check(const std::vector<Channel>& channels) const;

 private:
  Status apply_encoder(std::size_t channel, SampleBlock& block) const;
  Status apply_probe(const Probe& probe, std::size_t channel, SampleBlock& block) const;

  std::unordered_map<std::string, Probe> probes_;
  std::optional<double> encoder_um_per_V_;
  std::string rig_source_;
};

}  // namespace mdof::drivers
