// Measurement Computing USB-1608FS-Plus: eight 16-bit converters that sample at the same instant.
// Conversion between bytes (little-endian) and values, for the vendor control requests and the
// samples on bulk IN 0x81. Sources: Measurement Computing's uldaq (Usb1608fsPlus, AiUsb1608fsPlus),
// W. Jasper's mcc-libusb.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "schema/base/result.h"

namespace mdof::drivers::mcc_usb1608fs_plus {

inline constexpr std::uint16_t kVendor = 0x09DB, kProduct = 0x00EA;
inline constexpr std::uint8_t kSamplesIn = 0x81;
inline constexpr std::size_t kInputs = 8;
inline constexpr std::size_t kPacket = 64;
inline constexpr double kMostRate_Hz = 100'000, kMostSamples_Hz = 400'000;

enum Request : std::uint8_t {
  kScanStart = 0x11,
  kScanStop = 0x12,
  kConfig = 0x14,
  kClearFifo = 0x15,
  kCalibrationMemory = 0x30,
  kStatus = 0x44,
  kSerial = 0x48,
};
inline constexpr std::size_t kSerialBytes = 8;

// --- Ranges --------------------------------------------------------------------------------------

struct Range {
  double volts;  // the range is -volts ... +volts
  std::uint8_t code;
};
inline constexpr std::array<Range, 4> kRanges{{{10, 0}, {5, 1}, {2, 3}, {1, 5}}};
// nullopt: the device has no such range.
std::optional<Range> range_of(double volts);

// --- Scans ---------------------------------------------------------------------------------------

inline constexpr double kClock_Hz = 40e6;
struct ScanSetup {
  std::uint32_t scans = 0;  // number of scans; 0: until stopped
  std::uint32_t period = 0;
  std::uint8_t channels = 0;  // bit n is set: input n is scanned; lowest input first
  std::uint8_t options = 0;
};
enum Option : std::uint8_t {
  kImmediate = 0x01,  // the device sends each scan without waiting for a full packet
  kTestPattern = 0x20,
  kNoStall = 0x80,  // an overrun does not stall the endpoint
};
// Period for the nearest possible rate.
std::uint32_t pacer_period(double rate_hz);
double rate_of(std::uint32_t period);
std::string scan_start(const ScanSetup& setup);
std::optional<ScanSetup> read_scan_start(std::string_view bytes);
// Bytes that set the same range code for each input.
std::string config(std::uint8_t code);

struct DeviceStatus {
  bool running = false, overrun = false;
};
Result<DeviceStatus> read_status(std::string_view reply);
std::string status_reply(const DeviceStatus& status);

// Divides the samples of transfers into scans. A transfer may have any length.
class ScanSplitter {
 public:
  explicit ScanSplitter(std::size_t words) : words_(words) {}
  // Appends the words of the scans that end in `bytes`, one scan after the other.
  void take(std::string_view bytes, std::vector<std::uint16_t>& words);

 private:
  std::size_t words_;
  std::string begun_;
};

// --- Calibration ---------------------------------------------------------------------------------

inline constexpr std::size_t kPairBytes = 8;
struct Calibration {
  float slope = 1, offset = 0;  // offset in codes
};
using Calibrations = std::array<Calibration, kInputs>;
// Address, in the calibration memory, of the constants for a range and an input.
std::uint16_t calibration_address(std::uint8_t range_code, std::size_t input);
// Error: the constants are impossible, because the memory was erased or is damaged.
Result<Calibration> read_calibration(std::string_view pair);
// Makes a calibration memory with the same constants for every range.
std::string calibration_memory(const Calibrations& calibrations);

// The result is neither rounded to a code nor limited to the range. The vendor's library does the
// same; rounding would add quantisation noise.
double volts(std::uint16_t raw, const Calibration& calibration, double range_v);
// Whether the uncalibrated code is at an end of the converter's range.
inline bool at_rail(std::uint16_t raw) {
  return raw == 0 || raw == 0xFFFF;
}

}  // namespace mdof::drivers::mcc_usb1608fs_plus
