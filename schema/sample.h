// Samples as drivers return them, and frames. A frame contains all values of the rig at one
// instant.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace mdof {

// From best to worst. A value keeps its quality in all steps from the device to the compensation
// table.
enum class Quality : std::uint8_t {
  good = 0,
  simulated = 1,   // as good, but from a simulation and not from a machine
  suspect = 2,     // was read after an error that may have shifted or delayed it
  over_range = 3,  // the probe is at an end of its range
  stale = 4,       // older than the maximum age
  missing = 5,     // was not received; the value is NaN
};
inline constexpr int kQualityCount = 6;
const char* to_string(Quality quality);
inline bool usable(Quality q) {
  return q <= Quality::simulated;
}

// Unit of the raw numbers of a channel; the column "A_um" is channel "A" in µm. Calibrator
// (drivers/calibration.h) converts the first three units to `metre`.
enum class Unit : std::uint8_t { um = 0, mm = 1, volt = 2, deg_c = 3, other = 4, metre = 5 };
const char* suffix(Unit unit);  // "um", "mm", "V", "C", "", "m"

struct Channel {
  std::string id;        // probe id of the rig ("A" ...), or "encoder" for the axis position
  Unit unit = Unit::um;  // unit of the raw value
  bool operator==(const Channel&) const = default;
};
inline constexpr const char* kEncoderChannel = "encoder";

// Samples as a device sends them: n scans of the same channels, with one time stamp for each scan.
// The values are raw: not calibrated, averaged, aligned or filtered. The values of one channel are
// stored together, so that a recording compresses well and a loop over one channel reads the memory
// in order.
struct SampleBlock {
  std::string device;
  std::vector<Channel> channels;
  std::vector<std::int64_t> time_ns;  // monotonic clock, strictly increasing; set by the driver
  std::vector<std::vector<double>> value;     // [channel][scan], in the channel's unit
  std::vector<std::vector<Quality>> quality;  // [channel][scan]; empty: all values are good
  std::uint64_t lost = 0;  // number of scans that were lost directly before this block

  std::size_t scans() const { return time_ns.size(); }
  Quality quality_at(std::size_t channel, std::size_t scan) const {
    return quality.empty() || quality[channel].empty() ? Quality::good : quality[channel][scan];
  }
};

// Appends the scans `begin` to `end` - 1 of `from` to `to`. Both blocks must have the same
// channels. `lost` is not changed.
void append_scans(SampleBlock& to, const SampleBlock& from, std::size_t begin, std::size_t end);

// Displacements of all probes and position of the axis at n common instants; the instants are the
// time stamps of the encoder. SI units, calibrated. probe_m[k] is the displacement of the target in
// the direction `measures` of probe k; the probes are in the order of the rig. A missing value is
// NaN and has a quality.
struct FrameBlock {
  std::vector<std::int64_t> time_ns;
  std::vector<double> encoder_m;
  std::vector<std::vector<double>> probe_m;         // [probe][instant]
  std::vector<std::vector<Quality>> probe_quality;  // [probe][instant]; empty: all values are good
  // [probe][instant] 1: a new sample of the probe arrived after the previous instant; 0: the value
  // is interpolated from the same samples as at the previous instant. Empty: 1 everywhere.
  std::vector<std::vector<std::uint8_t>> probe_is_new = {};

  std::size_t size() const { return time_ns.size(); }
  Quality quality_at(std::size_t probe, std::size_t i) const {
    return probe_quality.empty() || probe_quality[probe].empty() ? Quality::good
                                                                 : probe_quality[probe][i];
  }
};

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

}  // namespace mdof
