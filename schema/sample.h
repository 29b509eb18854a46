// Samples as drivers deliver them, and frames: all values of the rig at one instant.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace mdof {

// From best to worst. A value keeps its quality from the device to the compensation table.
enum class Quality : std::uint8_t {
  good = 0,
  simulated = 1,   // good, but simulated instead of measured on a machine
  suspect = 2,     // read after an error that may have shifted or delayed it
  over_range = 3,  // the probe is at the end of its range
  stale = 4,       // older than the stated maximum age
  missing = 5,     // not received; the value is NaN
};
inline constexpr int kQualityCount = 6;
const char* to_string(Quality quality);
inline bool usable(Quality q) {
  return q <= Quality::simulated;
}

// Unit of the raw numbers of a channel; a column "A_um" is channel "A" in micrometres. Calibration
// converts the first three units to `metre`.
enum class Unit : std::uint8_t { um = 0, mm = 1, volt = 2, deg_c = 3, other = 4, metre = 5 };
const char* suffix(Unit unit);  // "um", "mm", "V", "C", "", "m"

struct Channel {
  std::string id;        // probe id of the rig ("A" ...), or "encoder" for the axis position
  Unit unit = Unit::um;  // of the raw value
  bool operator==(const Channel&) const = default;
};
inline constexpr const char* kEncoderChannel = "encoder";

// Samples as a device delivers them: n scans of the same channels, one time stamp a scan. The
// values are raw: not calibrated, averaged, aligned or filtered. They are stored by column, so that
// a recording compresses well and a loop over one channel reads memory in order.
struct SampleBlock {
  std::string device;
  std::vector<Channel> channels;
  std::vector<std::int64_t> time_ns;          // monotonic, strictly increasing; taken by the driver
  std::vector<std::vector<double>> value;     // [channel][scan], in the channel's unit
  std::vector<std::vector<Quality>> quality;  // [channel][scan]; empty: all good
  std::uint64_t lost = 0;  // scans known to be lost immediately before this block

  std::size_t scans() const { return time_ns.size(); }
  Quality quality_at(std::size_t channel, std::size_t scan) const {
    return quality.empty() || quality[channel].empty() ? Quality::good : quality[channel][scan];
  }
};

// Appends scans `begin` to `end` of `from` to `to`. Both have the same channels. The caller updates
// `lost`.
void append_scans(SampleBlock& to, const SampleBlock& from, std::size_t begin, std::size_t end);

// Displacements of all probes and the axis position at n common instants (the time stamps of the
// encoder); SI, calibrated. probe_m[k] is the displacement of the target in the direction
// `measures` of probe k, probes in the order of the rig. A missing value is NaN and has a quality.
struct FrameBlock {
  std::vector<std::int64_t> time_ns;
  std::vector<double> encoder_m;
  std::vector<std::vector<double>> probe_m;         // [probe][instant]
  std::vector<std::vector<Quality>> probe_quality;  // [probe][instant]; empty: all good
  // [probe][instant] 1 if a new sample of the probe arrived since the previous instant, 0 if the
  // value is interpolated from the same samples; empty: 1 everywhere.
  std::vector<std::vector<std::uint8_t>> probe_is_new = {};

  std::size_t size() const { return time_ns.size(); }
  Quality quality_at(std::size_t probe, std::size_t i) const {
    return probe_quality.empty() || probe_quality[probe].empty() ? Quality::good
                                                                 : probe_quality[probe][i];
  }
};

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

}  // namespace mdof
