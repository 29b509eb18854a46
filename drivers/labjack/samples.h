// Common code for the streams of the LabJack U6 and T7. The samples have 16 bits and come in the
// order of the scan list. The conversion to volts has one slope above and one slope below a centre
// code. Where scans were dropped, the device inserts a scan of 0xFFFF. Sources: U6 Datasheet 5.2.13
// and 5.4, T-Series Datasheet 3.2.4 and 14.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "schema/base/result.h"

namespace mdof::drivers::labjack {

// Constants for one range of the high-speed converter, from the flash memory of the device.
struct AinCalibration {
  double positive_slope = 0, negative_slope = 0;  // V per code; negative_slope is negative
  double centre = 0;                              // code
};
// Nominal constants for the range 10 V / 10^gain, with gain 0 ... 3.
AinCalibration nominal_calibration(std::size_t gain);
// Error: a constant is not finite or differs much from its nominal value, because the flash memory
// was erased or was read at a wrong address.
Status check(const AinCalibration& calibration, std::size_t gain);

double volts(const AinCalibration& calibration, std::uint16_t raw);
inline bool at_rail(std::uint16_t raw) {
  return raw == 0 || raw == 0xFFFF;
}

struct Scan {
  std::uint64_t index = 0;  // counted since the start of the stream; lost scans are counted too
  std::uint64_t lost = 0;   // number of lost scans between the previous scan and this scan
  std::vector<std::uint16_t> words;  // in the order of the scan list
};

// Divides the samples into scans and counts the scans. A scan may begin in one packet and end in a
// later packet.
class ScanSplitter {
 public:
  explicit ScanSplitter(std::size_t words_per_scan) : words_(words_per_scan) {}
  // Appends the scans that end in this packet to `scans`. `dropped`: number of missing scans that
  // the packet reports. A scan of 0xFFFF in the packet shows the position of the missing scans;
  // this scan is not returned. Error: the packet has no such scan, so that the times of later scans
  // are unknown. While it is unknown whether a scan was taken before or after the missing scans,
  // take() keeps the scan. A later call appends it.
  Status take(std::span<const std::uint16_t> samples, std::optional<std::uint64_t> dropped,
              std::vector<Scan>& scans);

 private:
  void end_scan(std::vector<Scan>& scans);

  std::size_t words_;
  std::vector<std::uint16_t> begun_;  // samples of an incomplete scan
  std::vector<Scan> held_;            // scans that are kept until the position of the gap is known
  std::optional<std::uint64_t> gap_;  // number of missing scans if their position is not known yet
  std::size_t candidates_ = 0;        // number of scans that may still show the position of the gap
  std::uint64_t next_ = 0;            // index of the next scan
  std::uint64_t lost_ = 0;            // number of lost scans before the next scan
};

}  // namespace mdof::drivers::labjack
