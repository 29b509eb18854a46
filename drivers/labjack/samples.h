// What the streams of LabJack's U6 and T7 have in common: 16-bit samples in the order of a scan
// list, in volts by a slope on either side of a centre, and a scan of 0xFFFF where scans were
// dropped. Sources: U6 Datasheet 5.2.13 and 5.4, T-Series Datasheet 3.2.4 and 14.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "schema/base/result.h"

namespace mdof::drivers::labjack {

// Of one range of the high-speed converter, as in the device's flash.
struct AinCalibration {
  double positive_slope = 0, negative_slope = 0;  // volts a code; the second is negative
  double centre = 0;                              // code
};
// Of the range 10 V / 10^gain, gain 0 ... 3.
AinCalibration nominal_calibration(std::size_t gain);
// Error: not finite, or far from nominal: flash that was erased or read at a wrong place.
Status check(const AinCalibration& calibration, std::size_t gain);

double volts(const AinCalibration& calibration, std::uint16_t raw);
inline bool at_rail(std::uint16_t raw) {
  return raw == 0 || raw == 0xFFFF;
}

struct Scan {
  std::uint64_t index = 0;           // since the start of the stream, lost ones counted
  std::uint64_t lost = 0;            // between the scan before and this one
  std::vector<std::uint16_t> words;  // in the order of the scan list
};

// Cuts samples into scans, which may run on from one packet to the next, and counts them.
class ScanSplitter {
 public:
  explicit ScanSplitter(std::size_t words_per_scan) : words_(words_per_scan) {}
  // Adds the scans that end in this packet to `scans`. `dropped`: the packet says that so many
  // scans are missing; the scan of 0xFFFF in it marks where and is not handed out. Error: there is
  // none, so that the times of later scans are not known. Scans of which it is not known yet
  // whether they come before or after are kept back.
  Status take(std::span<const std::uint16_t> samples, std::optional<std::uint64_t> dropped,
              std::vector<Scan>& scans);

 private:
  void end_scan(std::vector<Scan>& scans);

  std::size_t words_;
  std::vector<std::uint16_t> begun_;  // samples of a scan that has not ended
  std::vector<Scan> held_;            // until the gap is found
  std::optional<std::uint64_t> gap_;  // scans missing at a place not found yet
  std::size_t candidates_ = 0;        // scans that may still mark it
  std::uint64_t next_ = 0;            // index
  std::uint64_t lost_ = 0;            // before the next scan
};

}  // namespace mdof::drivers::labjack
