// Converts the raw readings of a device to displacements in metres and sets their quality. This
// step runs directly after the driver, so that later code handles no volts and no gaps in µm.
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

// Displacement, m, in the direction `measures`, for a raw reading in µm (schema/rig/rig.h,
// Calibration).
double displacement_m(const Calibration& calibration, double raw_um);

// Lower and upper limit of the displacement, m, in the direction `measures`. A reading between
// these limits is not at an end of the probe's measuring range.
std::array<double, 2> displacement_window_m(const Probe& probe);

// Makes one notice for each probe whose calibration record states um_per_V although the channel of
// the probe has a unit of length. For such a probe the amplifier sets the sensitivity, but the
// uncertainty u is taken from the calibration record.
Notices unused_scales(const Rig& rig, const std::vector<Channel>& channels);
// Makes one notice that names the channels of a length or voltage that are neither a probe of the
// rig nor the encoder.
Notices unused_channels(const Rig& rig, const std::vector<Channel>& channels);

// Reentrant. Copies the data of the rig that it needs.
class Calibrator {
 public:
  explicit Calibrator(const Rig& rig);

  // Converts the readings of the probes and of the encoder in `block` to Unit::metre, in place. A
  // reading within 0.05 % of an end of the probe's range gets Quality::over_range. A NaN gets
  // Quality::missing. Channels that are not in the rig are left unchanged. Errors: a channel in
  // volts has no um_per_V; the unit of a probe or of the encoder is not a length.
  Status apply(SampleBlock& block) const;
  // Reports the same errors as apply() for the channels of a device, before the device sends
  // samples.
  Status check(const std::vector<Channel>& channels) const;

 private:
  Status apply_encoder(std::size_t channel, SampleBlock& block) const;
  Status apply_probe(const Probe& probe, std::size_t channel, SampleBlock& block) const;

  std::unordered_map<std::string, Probe> probes_;
  std::optional<double> encoder_um_per_V_;
  std::string rig_source_;
};

}  // namespace mdof::drivers
