#include "drivers/mcc_usb1608fs_plus/protocol.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace mdof::drivers::mcc_usb1608fs_plus {
namespace {

constexpr std::size_t kScanStartBytes = 10;
constexpr unsigned kRunningBit = 2, kOverrunBit = 4;

std::uint32_t number_at(std::string_view bytes, std::size_t at, std::size_t size) {
  std::uint32_t value = 0;
  for (std::size_t i = size; i-- > 0;)
    value = value << 8 | static_cast<std::uint8_t>(bytes[at + i]);
  return value;
}
void append(std::string& bytes, std::uint32_t value, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) bytes += static_cast<char>(value >> 8 * i & 0xFF);
}

bool possible(const Calibration& c) {
  // Larger than the deviation of any device; NaN is rejected too.
  constexpr float kSlope = 0.1F, kOffset = 4000;
  return std::abs(c.slope - 1) <= kSlope && std::abs(c.offset) <= kOffset;
}

}  // namespace

std::optional<Range> range_of(double volts) {
  for (const Range& range : kRanges)
    if (range.volts == volts) return range;
  return std::nullopt;
}

std::uint32_t pacer_period(double rate_hz) {
  const double ticks = std::round(kClock_Hz / rate_hz) - 1;
  return static_cast<std::uint32_t>(std::clamp(ticks, 1.0, 4294967295.0));
}

double rate_of(std::uint32_t period) {
  return kClock_Hz / (period + 1.0);
}

std::string scan_start(const ScanSetup& setup) {
  std::string bytes;
  append(bytes, setup.scans, 4);
  append(bytes, setup.period, 4);
  append(bytes, setup.channels, 1);
  append(bytes, setup.options, 1);
  return bytes;
}

std::optional<ScanSetup> read_scan_start(std::string_view bytes) {
  if (bytes.size() != kScanStartBytes) return std::nullopt;
  return ScanSetup{number_at(bytes, 0, 4), number_at(bytes, 4, 4),
                   static_cast<std::uint8_t>(bytes[8]), static_cast<std::uint8_t>(bytes[9])};
}

std::string config(std::uint8_t code) {
  return std::string(kInputs, static_cast<char>(code));
}

Result<DeviceStatus> read_status(std::string_view reply) {
  if (reply.size() != 2) return io_error("the status of the device is incomplete");
  const std::uint32_t bits = number_at(reply, 0, 2);
  return DeviceStatus{(bits & kRunningBit) != 0, (bits & kOverrunBit) != 0};
}

std::string status_reply(const DeviceStatus& status) {
  std::string bytes;
  append(bytes, (status.running ? kRunningBit : 0) | (status.overrun ? kOverrunBit : 0), 2);
  return bytes;
}

void ScanSplitter::take(std::string_view bytes, std::vector<std::uint16_t>& words) {
  begun_ += bytes;
  const std::size_t whole = begun_.size() - begun_.size() % (2 * words_);
  for (std::size_t at = 0; at < whole; at += 2)
    words.push_back(static_cast<std::uint16_t>(number_at(begun_, at, 2)));
  begun_.erase(0, whole);
}

std::uint16_t calibration_address(std::uint8_t range_code, std::size_t input) {
  return static_cast<std::uint16_t>(kPairBytes * (kInputs * range_code + input));
}

Result<Calibration> read_calibration(std::string_view pair) {
  if (pair.size() != kPairBytes)
    return io_error("the data of the calibration memory are incomplete");
  const Calibration c{std::bit_cast<float>(number_at(pair, 0, 4)),
                      std::bit_cast<float>(number_at(pair, 4, 4))};
  if (possible(c)) return c;
  return io_error("the constants in the calibration memory are impossible (slope " +
                  std::to_string(c.slope) + ", offset " + std::to_string(c.offset) +
                  " codes); send the device to Measurement Computing for calibration");
}

std::string calibration_memory(const Calibrations& calibrations) {
  std::string memory;
  for (std::size_t code = 0; code < kInputs; ++code)
    for (const Calibration& c : calibrations) {
      append(memory, std::bit_cast<std::uint32_t>(c.slope), 4);
      append(memory, std::bit_cast<std::uint32_t>(c.offset), 4);
    }
  return memory;
}

double volts(std::uint16_t raw, const Calibration& c, double range_v) {
  constexpr double kZero = 32768;
  return (raw * static_cast<double>(c.slope) + c.offset - kZero) * range_v / kZero;
}

}  // namespace mdof::drivers::mcc_usb1608fs_plus
