#include <algorithm>
#include <cassert>
#include <cmath>

#include "drivers/labjack_u6/protocol.h"

namespace mdof::drivers::labjack_u6 {
namespace {

constexpr std::uint8_t kStart = 0xA8, kStop = 0xB0;
constexpr int kProVersion = 12;
// Bits of a channel's options: LabJackPython, src/u6.py, U6.streamConfig.
constexpr int kGainBits = 4, kDifferential = 0x80;
constexpr char kConfigureTimer0 = 0x2B, kConfigureTimer1 = 0x2D, kQuadrature = 8;

std::uint32_t u32_at(std::string_view bytes, std::size_t i) {
  return byte_at(bytes, i) | static_cast<std::uint32_t>(byte_at(bytes, i + 1)) << 8 |
         static_cast<std::uint32_t>(byte_at(bytes, i + 2)) << 16 |
         static_cast<std::uint32_t>(byte_at(bytes, i + 3)) << 24;
}

Status refused(const char* command, int code) {
  if (code == 0) return {};
  return io_error(std::string(command) + " was refused: " + error_text(code));
}

// Returns the body of a reply whose first byte is an error code.
Result<std::string> accepted(const char* name, std::string_view reply, std::uint8_t command,
                             std::size_t size) {
  MDOF_TRY(std::string body, extended_body(reply, command, size));
  MDOF_CHECK(refused(name, byte_at(body, 0)));
  return body;
}

}  // namespace

std::string error_text(int code) {
  struct Row {
    int code;
    const char* text;
  };
  constexpr Row kRows[] = {
      {kStreamActive, "a stream is already active"},
      {49, "the stream's configuration is invalid"},
      {50, "the stream's configuration is invalid"},
      {kNotRunning, "no stream was running"},
      {kScanOverlap,
       "a scan began before the previous scan had ended: lower rate_hz or resolution_index"},
      {56, "the number of samples in a packet is invalid"},
      {kRateInvalid, "the scan rate is invalid: change rate_hz"},
      {kRecovering, "the stream's buffer was full and is being emptied"},
      {kRecovered, "the stream continues after dropped scans"},
      {kRecoveryOverflow, "more scans were dropped than the device can count: lower rate_hz"},
  };
  std::string number = "U6 error " + std::to_string(code);
  for (const Row& row : kRows)
    if (row.code == code) return number + ", " + row.text;
  return number;
}

std::string config_u6() {
  return extended(kConfigU6, std::string(20, '\0'));
}

Result<Identity> read_config_u6(std::string_view reply) {
  MDOF_TRY(const std::string body, accepted("ConfigU6", reply, kConfigU6, 38));
  Identity identity;
  identity.firmware_minor = byte_at(reply, 9);
  identity.firmware_major = byte_at(reply, 10);
  identity.serial = u32_at(reply, 15);
  identity.pro = byte_at(reply, 37) == kProVersion;
  return identity;
}

std::string read_calibration(int block) {
  assert(block >= 0 && block < kCalibrationBlocks);
  return extended(kReadCalibration, std::string{'\0', static_cast<char>(block)});
}

// The numbers have a fixed point: 32 bits of fraction, then a signed integer of 32 bits.
Result<CalibrationBlock> read_calibration_reply(std::string_view reply) {
  MDOF_TRY(const std::string body,
           accepted("the command that reads the calibration", reply, kReadCalibration, 40));
  CalibrationBlock block{};
  for (std::size_t i = 0; i < block.size(); ++i) {
    const double fraction = u32_at(reply, 8 + 8 * i);
    const auto whole = static_cast<std::int32_t>(u32_at(reply, 12 + 8 * i));
    block[i] = whole + fraction / 4294967296.0;
  }
  return block;
}

Result<AinCalibration> calibration_of(const std::array<CalibrationBlock, 4>& blocks,
                                      std::size_t gain) {
  const CalibrationBlock& up = blocks.at(gain / 2);
  const CalibrationBlock& down = blocks.at(2 + gain / 2);
  const std::size_t at = 2 * (gain % 2);
  const AinCalibration calibration{up[at], down[at], down[at + 1]};
  MDOF_CHECK(labjack::check(calibration, gain));
  return calibration;
}

std::string config_io(int timers, int pin_offset) {
  std::string body(10, '\0');
  body[0] = 1;  // write
  body[1] = static_cast<char>(timers);
  body[3] = static_cast<char>(pin_offset);
  return extended(kConfigIo, body);
}

std::string config_io_read() {
  return extended(kConfigIo, std::string(10, '\0'));
}

Result<Timers> read_timers(std::string_view reply) {
  MDOF_TRY(const std::string body, accepted("ConfigIO", reply, kConfigIo, kConfigIoReply));
  return Timers{byte_at(reply, 8), byte_at(reply, 10)};
}

Status read_config_io(std::string_view reply, int timers, int pin_offset) {
  MDOF_TRY(const Timers is, read_timers(reply));
  if (is.count == timers && is.pin_offset == pin_offset) return {};
  return io_error("the U6 did not accept the configuration of its timers");
}

std::string start_quadrature() {
  const std::string mode{kQuadrature, 0, 0};  // the count starts at 0
  const std::string start(1, '\0'), even(1, '\0');
  return extended(kFeedback, start + kConfigureTimer0 + mode + kConfigureTimer1 + mode + even);
}

// The reply contains the error code, the index of the failed command, the echo, and a byte that
// makes the length even.
Status read_feedback(std::string_view reply) {
  MDOF_TRY(const std::string body, accepted("Feedback", reply, kFeedback, 10));
  return {};
}

std::optional<StreamClock> stream_clock(double rate_hz) {
  constexpr double kClock_Hz = 4e6;
  constexpr std::uint8_t kBy256 = 2;
  if (!(rate_hz > 0)) return std::nullopt;
  for (const bool divided : {false, true}) {
    const double clock_Hz = divided ? kClock_Hz / 256 : kClock_Hz;
    const double interval = std::round(clock_Hz / rate_hz);
    if (interval >= 1 && interval <= 65535)
      return StreamClock{divided ? kBy256 : std::uint8_t{0}, static_cast<std::uint16_t>(interval),
                         clock_Hz / interval};
  }
  return std::nullopt;
}

std::string stream_config(const StreamSetup& setup, const StreamClock& clock) {
  std::string body;
  for (const int value :
       {static_cast<int>(setup.list.size()), setup.resolution_index, setup.samples_per_packet, 0,
        setup.settling_10us, static_cast<int>(clock.config), clock.interval & 0xFF,
        clock.interval >> 8})
    body += static_cast<char>(value);
  for (const Entry& entry : setup.list) {
    body += static_cast<char>(entry.channel);
    body += static_cast<char>(entry.gain << kGainBits | (entry.differential ? kDifferential : 0));
  }
  return extended(kStreamConfig, body);
}

Status read_stream_config(std::string_view reply) {
  MDOF_TRY(const std::string body, accepted("StreamConfig", reply, kStreamConfig, 8));
  return {};
}

std::string stream_start() {
  return normal(kStart);
}

Status read_stream_start(std::string_view reply) {
  MDOF_TRY(const int code, normal_error(reply, kStart));
  return refused("StreamStart", code);
}

std::string stream_stop() {
  return normal(kStop);
}

Status read_stream_stop(std::string_view reply) {
  MDOF_TRY(const int code, normal_error(reply, kStop));
  return code == kNotRunning ? Status{} : refused("StreamStop", code);
}

}  // namespace mdof::drivers::labjack_u6
