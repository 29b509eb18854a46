// Common parts of the streams of LabJack's U6 and T7: 16-bit samples in the order of a scan list,
// converted to volts with one slope on each side of a centre, and a scan of 0xFFFF where scans were
// dropped. Sources: U6 Datasheet 5.2.13 and 5.4, T-Series Datasheet 3.2.4 and 14.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "schema/base/result.h"

namespace mdof::drivers::labjack {

// Constants of one range of the high-speed converter, from the flash of the device.
struct AinCalibration {
  double positive_slope = 0, negative_slope = 0;  // V per code; the second is negative
  double centre = 0;                              // code
};
// For the range 10 V / 10^gain, gain 0 ... 3.
AinCalibration nominal_calibration(std::size_t gain);
// Error: a constant is not finite or far from nominal, because the flash was erased or read at a
// wrong address.
Status check(const AinCalibration& calibration, std::size_t gain);

double volts(const AinCalibration& calibration, std::uint16_t raw);
inline bool at_rail(std::uint16_t raw) {
  return raw == 0 || raw == 0xFFFF;
}

struct Scan {
  std::uint64_t index = 0;           // since the start of the stream, including lost scans
  std::uint64_t lost = 0;            // between the previous scan and this one
  std::vector<std::uint16_t> words;  // in the order of the scan list
};

// Cuts samples into scans, which may extend over several packets, and counts the scans.
class ScanSplitter {
 public:
  explicit ScanSplitter(std::size_t words_per_scan) : words_(words_per_scan) {}
  // Appends the scans that end in this packet to `scans`. `dropped`: number of missing scans that
  // the packet reports; a scan of 0xFFFF in the packet marks their position and is not returned.
  // Error: no scan marks it, so the times of later scans are unknown. Scans whose side of the gap
  // is still unknown are held back.
  Status take(std::span<const std::uint16_t> samples, std::optional<std::uint64_t> dropped,
              std::vector<Scan>& scans);

 private:
  void end_scan(std::vector<Scan>& scans);

  std::size_t words_;
  std::vector<std::uint16_t> begun_;  // samples of an incomplete scan
  std::vector<Scan> held_;            // scans held until the gap is found
  std::optional<std::uint64_t> gap_;  // number of missing scans of a gap that is not found yet
  std::size_t candidates_ = 0;        // scans that may still mark the gap
  std::uint64_t next_ = 0;            // index of the next scan
  std::uint64_t lost_ = 0;            // scans lost before the next scan
};

}  // namespace mdof::drivers::labjack
