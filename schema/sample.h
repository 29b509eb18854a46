// What drivers put out and what one instant of the whole rig looks like.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace mdof {

// From best to worst; travels with the value from the device to the compensation table.
enum class Quality : std::uint8_t {
  good = 0,
  simulated = 1,   // good in every respect but that no machine was there
  suspect = 2,     // came after an error that may have shifted or delayed it
  over_range = 3,  // the probe is at the end of its range
  stale = 4,       // older than its stated age
  missing = 5,     // never came; the value is NaN
};
inline constexpr int kQualityCount = 6;
const char* to_string(Quality quality);
inline bool usable(Quality q) {
  return q <= Quality::simulated;
}

// How a channel's raw numbers are to be read; a column "A_um" is channel "A" in micrometres.
// `metre` is what calibration makes of the first three.
enum class Unit : std::uint8_t { um = 0, mm = 1, volt = 2, deg_c = 3, other = 4, metre = 5 };
const char* suffix(Unit unit);  // "um", "mm", "V", "C", "", "m"

struct Channel {
  std::string id;        // "A" ... as in the rig; "encoder" for the axis position
  Unit unit = Unit::um;  // of the raw value
  bool operator==(const Channel&) const = default;
};
inline constexpr const char* kEncoderChannel = "encoder";

// Samples as a device gives them: n scans of the same channels, one time stamp a scan.
// Raw: nothing is calibrated, averaged, aligned or left out. Columns, so that a recording
// compresses well and a loop over one channel runs through memory in order.
struct SampleBlock {
  std::string device;
  std::vector<Channel> channels;
  std::vector<std::int64_t> time_ns;          // monotonic, strictly increasing; taken by the driver
  std::vector<std::vector<double>> value;     // [channel][scan], in the channel's unit
  std::vector<std::vector<Quality>> quality;  // [channel][scan]; empty: all good
  std::uint64_t lost = 0;                     // scans known to be lost just before this block

  std::size_t scans() const { return time_ns.size(); }
  Quality quality_at(std::size_t channel, std::size_t scan) const {
    return quality.empty() || quality[channel].empty() ? Quality::good : quality[channel][scan];
  }
};

// Scans `begin` to `end` of `from`, which has the channels of `to`, after those that are there.
// What was lost is left to the caller.
void append_scans(SampleBlock& to, const SampleBlock& from, std::size_t begin, std::size_t end);

// All probes and the axis position on the encoder's time line: n instants, SI, calibrated.
// probe_m[k] is the displacement of the target along probe k's `measures` direction, probes in
// the order of the rig; a missing value is NaN with its quality beside it.
struct FrameBlock {
  std::vector<std::int64_t> time_ns;
  std::vector<double> encoder_m;
  std::vector<std::vector<double>> probe_m;         // [probe][instant]
  std::vector<std::vector<Quality>> probe_quality;  // [probe][instant]; empty: all good
  // [probe][instant] 1 where a sample of the probe's own has come since the instant before, 0 where
  // the value is only interpolated anew from the same samples; empty: 1 everywhere.
  std::vector<std::vector<std::uint8_t>> probe_fresh = {};

  std::size_t size() const { return time_ns.size(); }
  Quality quality_at(std::size_t probe, std::size_t i) const {
    return probe_quality.empty() || probe_quality[probe].empty() ? Quality::good
                                                                 : probe_quality[probe][i];
  }
};

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

}  // namespace mdof
