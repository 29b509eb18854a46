// LabJack U6 and U6-Pro over USB: conversion between bytes and values, for commands (bulk OUT 1,
// replies IN 2) and for the stream (bulk IN 3). Little-endian. Source: U6 Datasheet 5.1, 5.2, 5.4;
// LabJack's open exodriver.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/labjack/samples.h"
#include "schema/base/result.h"

namespace mdof::drivers::labjack_u6 {

using labjack::AinCalibration;
using labjack::Scan;

inline constexpr std::uint16_t kVendor = 0x0CD5, kProduct = 6;
inline constexpr std::uint8_t kCommandOut = 0x01, kReplyIn = 0x82, kStreamIn = 0x83;

inline constexpr int kAins = 14;                  // AIN0 ... AIN13
inline constexpr std::size_t kCommandBytes = 64;  // length of the longest command or reply

// Entries of the scan list that are not an AIN 0 ... 13.
inline constexpr int kTimer0 = 200;  // lower word of timer 0; kTimer0 + 1 is timer 1, and so on
// Upper word of the count whose lower word is the previous entry.
inline constexpr int kCapture = 224;

enum Command : std::uint8_t {
  kFeedback = 0x00,
  kConfigU6 = 0x08,
  kConfigIo = 0x0B,
  kStreamConfig = 0x11,
  kReadCalibration = 0x2D,
};
enum ErrorCode : std::uint8_t {
  kStreamActive = 48,
  kNotRunning = 52,
  kScanOverlap = 55,
  kRateInvalid = 58,
  kRecovering = 59,        // the buffer was full; scans are being dropped
  kRecovered = 60,         // `dropped` scans are missing; a scan of 0xFFFF shows the position
  kRecoveryOverflow = 63,  // more scans were dropped than the device can count
};
std::string error_text(int code);

// --- Frames --------------------------------------------------------------------------------------

inline std::uint8_t byte_at(std::string_view bytes, std::size_t i) {
  return static_cast<std::uint8_t>(bytes[i]);
}
std::uint8_t checksum8(std::string_view bytes);
std::uint16_t checksum16(std::string_view bytes);
// `body`: the bytes from byte 6 on. Their number must be even.
std::string extended(std::uint8_t command, std::string_view body);
std::string normal(std::uint8_t command);
// Returns the bytes after byte 5. Errors: the reply is B8 B8 (the device has detected a wrong
// checksum); the reply is too short; its checksum is wrong; it belongs to another command.
Result<std::string> extended_body(std::string_view reply, std::uint8_t command, std::size_t size);
// Returns the error code in a four-byte reply to a normal command. Errors as in extended_body().
Result<int> normal_error(std::string_view reply, std::uint8_t command);

// --- Commands ------------------------------------------------------------------------------------

struct Identity {
  std::uint32_t serial = 0;
  int firmware_major = 0, firmware_minor = 0;
  bool pro = false;
};
std::string config_u6();
Result<Identity> read_config_u6(std::string_view reply);

inline constexpr int kCalibrationBlocks = 10;
using CalibrationBlock = std::array<double, 4>;
std::string read_calibration(int block);
Result<CalibrationBlock> read_calibration_reply(std::string_view reply);
// Calibration constants for the gain 0 ... 3. Blocks 0 and 1 contain slope and offset of each gain,
// blocks 2 and 3 the negative slope and the centre. Error: impossible constants.
Result<AinCalibration> calibration_of(const std::array<CalibrationBlock, 4>& blocks,
                                      std::size_t gain);

inline constexpr std::size_t kConfigIoReply = 16;  // bytes

struct Timers {
  int count = 0, pin_offset = 0;  // number of timers; the first timer is on line FIO(pin_offset)
};
std::string config_io_read();
Result<Timers> read_timers(std::string_view reply);
std::string config_io(int timers, int pin_offset);
Status read_config_io(std::string_view reply, int timers, int pin_offset);
// Returns the command that sets timers 0 and 1 to mode 8, a quadrature counter that starts at 0.
// The timers use the first two lines from the pin offset on.
std::string start_quadrature();
Status read_feedback(std::string_view reply);

inline constexpr int kMostSamples = 25;  // largest number of samples in a packet
// An entry of the scan list. Gain 0 ... 3: range 10 V / 10^gain. `differential`: the input is an
// even AIN, and its voltage is measured relative to the next AIN.
struct Entry {
  int channel = 0;  // 0 ... 13, or kTimer0, kCapture
  int gain = 0;
  bool differential = false;
};
struct StreamSetup {
  int samples_per_packet = 25;
  int resolution_index = 1;
  int settling_10us = 0;
  std::vector<Entry> list;
};
struct StreamClock {
  std::uint8_t config = 0;
  std::uint16_t interval = 0;
  double rate_hz = 0;  // actual rate
};
// The nearest possible rate; nullopt: no divisor of the clock produces so low or so high a rate.
std::optional<StreamClock> stream_clock(double rate_hz);
std::string stream_config(const StreamSetup& setup, const StreamClock& clock);
Status read_stream_config(std::string_view reply);
std::string stream_start();
Status read_stream_start(std::string_view reply);
std::string stream_stop();
Status read_stream_stop(std::string_view reply);  // no error if no stream was running

// --- Stream --------------------------------------------------------------------------------------

struct StreamData {
  std::uint8_t counter = 0;
  std::uint8_t error = 0;
  std::uint8_t backlog = 0;   // filling of the device's buffer, in 1/256
  std::uint16_t dropped = 0;  // number of dropped scans, if error is kRecovered
  std::vector<std::uint16_t> samples;
};
inline constexpr std::size_t stream_bytes(std::size_t samples) {
  return 14 + 2 * samples;
}
std::string encode(const StreamData& packet);
// `bytes`: one packet with `samples` samples. Errors: a wrong length, type or checksum.
Result<StreamData> decode(std::string_view bytes, std::size_t samples);

// Numbers the scans in the packets. Scans that the device dropped are counted too.
class ScanNumbering {
 public:
  explicit ScanNumbering(std::size_t words_per_scan) : line_(words_per_scan) {}
  // Appends the scans that end in the packet to `scans`. Error: packets are missing, the device has
  // stopped, or the position of dropped scans is unknown. After an error the stream must be started
  // again.
  Status take(const StreamData& packet, std::vector<Scan>& scans);

 private:
  labjack::ScanSplitter line_;
  std::uint8_t counter_ = 0;  // number of the next packet
};

}  // namespace mdof::drivers::labjack_u6
