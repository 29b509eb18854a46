// Converts raw readings of a device to displacements in metres and sets their quality. This is the
// last step after every driver: later code needs no volts or gaps.
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

// Displacement along `measures`, m, for a raw reading in µm (schema/rig/rig.h, Calibration).
double displacement_m(const Calibration& calibration, double raw_um);

// The lower and the upper displacement along `measures`, m. A reading between them is not at the
// end of the range of the probe.
std::array<double, 2> displacement_window_m(const Probe& probe);

// One notice for each probe whose calibration record states um_per_V although its channel gives a
// length. The amplifier then sets the sensitivity, but u still comes from the record.
Notices unused_scales(const Rig& rig, const std::vector<Channel>& channels);

// Reentrant. Copies the parts of the rig that it needs.
class Calibrator {
 public:
  explicit Calibrator(const Rig& rig);

  // Converts the probes and the encoder of `block` to Unit::metre, in place. A reading at the end
  // of its probe's range (within 0.05 % of it) gets Quality::over_range, a NaN gets
  // Quality::missing. Channels that are not in the rig are left unchanged. Errors: a channel in
  // volts without um_per_V; a probe or the encoder in a unit that is not a length.
  Status apply(SampleBlock& block) const;
  // Reports the same errors for the channels of a device, before the device gives samples.
  Status check(const std::vector<Channel>& channels) const;

 private:
  Status apply_encoder(std::size_t channel, SampleBlock& block) const;
  Status apply_probe(const Probe& probe, std::size_t channel, SampleBlock& block) const;

  std::unordered_map<std::string, Probe> probes_;
  std::optional<double> encoder_um_per_V_;
  std::string rig_source_;
};

}  // namespace mdof::drivers
