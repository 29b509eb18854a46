#include "drivers/labjack_u6/simulated_labjack_u6.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "schema/sample.h"

namespace mdof::drivers::labjack_u6 {
namespace {

constexpr std::int64_t kSlot_ns = 10'000;  // time between two entries of the scan list
constexpr int kRecoveryPackets = 3;
constexpr std::size_t kFewBytes = 20;
constexpr int kBadConfiguration = 49;

std::string normal_reply(std::uint8_t command, int error) {
  std::string reply{static_cast<char>(command + 1), static_cast<char>(error), 0};
  return static_cast<char>(checksum8(reply)) + reply;
}

// The device has one interface with three bulk endpoints of 64 bytes: U6 Datasheet 5, exodriver.
usb::Identity identity_of(std::uint32_t serial, bool nameless) {
  usb::Identity identity;
  identity.vendor = kVendor;
  identity.product = kProduct;
  identity.manufacturer = "LabJack Corporation";
  identity.product_name = "LabJack U6";
  identity.serial = nameless ? "" : std::to_string(serial);
  identity.configuration = std::string("\x09\x02\x27\x00\x01\x01\x00\x80\xFA", 9) +
                           std::string("\x09\x04\x00\x00\x03\xFF\x00\x00\x00", 9);
  for (const std::uint8_t endpoint : {kCommandOut, kReplyIn, kStreamIn})
    identity.configuration += std::string{7, 5, static_cast<char>(endpoint), 2, 64, 0, 0};
  return identity;
}

void append_fixed(std::string& body, double value) {
  const auto fixed = static_cast<std::uint64_t>(std::llround(value * 4294967296.0));
  for (int i = 0; i < 8; ++i) body += static_cast<char>(fixed >> 8 * i & 0xFF);
}

// Blocks 0 and 1: slope and offset of gains 0 ... 3; blocks 2 and 3: negative slope and centre; all
// other numbers are 0.
std::string constants(int block) {
  std::string body(2, '\0');
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t gain = static_cast<std::size_t>(block % 2) * 2 + i / 2;
    const AinCalibration c = SimulatedLabjackU6::calibration(gain);
    const double up = i % 2 == 0 ? c.positive_slope : 0;
    const double down = i % 2 == 0 ? c.negative_slope : c.centre;
    append_fixed(body, block < 2 ? up : block < 4 ? down : 0);
  }
  return extended(kReadCalibration, body);
}

}  // namespace

SimulatedLabjackU6::SimulatedLabjackU6(Senses senses, const Options& options)
    : senses_(std::move(senses)),
      faults_(options.faults),
      serial_(options.serial),
      identity_(identity_of(serial_, faults_.nameless)),
      running_(faults_.streaming) {
  if (running_) packets_.push_back(encode({7, 0, 0, 0, std::vector<std::uint16_t>(25)}));
}

void SimulatedLabjackU6::restart() {
  *this = SimulatedLabjackU6(std::move(senses_), {.serial = serial_});
}

std::string SimulatedLabjackU6::identity_body() const {
  std::string body(32, '\0');
  body[3] = 15;  // firmware 1.15
  body[4] = 1;
  for (std::size_t i = 0; i < 4; ++i) body[9 + i] = static_cast<char>(serial_ >> 8 * i);
  body[13] = 6;
  body[31] = 4;
  return extended(kConfigU6, body);
}

// The constants differ a little from the nominal constants and from gain to gain, so that tests
// detect a wrong block.
AinCalibration SimulatedLabjackU6::calibration(std::size_t gain) {
  AinCalibration c = labjack::nominal_calibration(gain);
  c.positive_slope *= 1.001 + 0.0002 * static_cast<double>(gain);
  c.negative_slope *= 0.999;
  c.centre += 5.5 + static_cast<double>(gain);
  return c;
}

usb::Reply SimulatedLabjackU6::control(const usb::Setup& /*setup*/, std::string_view /*out*/,
                                       std::int64_t /*now_ns*/) {
  return {usb::Answer::stall, ""};
}

usb::Reply SimulatedLabjackU6::out(std::uint8_t endpoint, std::string_view bytes,
                                   std::int64_t now_ns) {
  if (endpoint != kCommandOut) return {usb::Answer::stall, ""};
  std::string reply = answer(bytes, now_ns);
  if (faults_.wrong_checksum) reply[0] = static_cast<char>(reply[0] ^ 0x55);
  replies_.push_back(std::move(reply));
  return {};
}

usb::Reply SimulatedLabjackU6::in(std::uint8_t endpoint, std::size_t max_bytes,
                                  std::int64_t now_ns) {
  if (endpoint == kStreamIn) {
    take_scans(now_ns);
    return stream_in(max_bytes);
  }
  if (endpoint != kReplyIn) return {usb::Answer::stall, ""};
  if (replies_.empty()) return {usb::Answer::not_yet, ""};
  usb::Reply reply{usb::Answer::done, std::move(replies_.front())};
  replies_.pop_front();
  return reply;
}

// Returns complete packets until the transfer is full. A short packet ends the transfer.
usb::Reply SimulatedLabjackU6::stream_in(std::size_t max_bytes) {
  std::size_t bytes = 0, packets = 0;
  bool ends = false;
  while (!ends && packets < packets_.size()) {
    const std::size_t size = packets_[packets].size();
    ends = size < usb::kFullSpeedPacket || bytes + size >= max_bytes;
    bytes += size;
    ++packets;
  }
  if (!ends) return {usb::Answer::not_yet, ""};
  usb::Reply reply;
  for (; packets > 0; --packets) {
    reply.bytes += packets_.front();
    packets_.pop_front();
  }
  return reply;
}

std::string SimulatedLabjackU6::answer(std::string_view command, std::int64_t now_ns) {
  constexpr const char* kBad = "\xB8\xB8";
  if (faults_.deaf || command.size() < 2) return kBad;
  if (command.size() == 2) return answer_normal(command, now_ns);
  if (command.size() < 8 || !extended_body(command, byte_at(command, 3), command.size()))
    return kBad;
  return answer_extended(command, now_ns);
}

std::string SimulatedLabjackU6::answer_normal(std::string_view command, std::int64_t now_ns) {
  const std::uint8_t code = byte_at(command, 1);
  if (command[0] != command[1]) return "\xB8\xB8";
  if (command == stream_start()) {
    if (running_) return normal_reply(code, kStreamActive);
    if (list_.empty()) return normal_reply(code, kBadConfiguration);
    running_ = true;
    packets_.clear();
    stream_ = Stream{now_ns, 0, 0};
    return normal_reply(code, 0);
  }
  const bool ran = std::exchange(running_, false);
  stream_.reset();
  return normal_reply(code, ran ? 0 : kNotRunning);
}

std::string SimulatedLabjackU6::answer_extended(std::string_view command, std::int64_t now_ns) {
  const std::uint8_t code = byte_at(command, 3);
  if ((code == kConfigIo || code == kStreamConfig) && command.size() < 16) return "\xB8\xB8";
  switch (code) {
    case kConfigU6:
      return identity_body();
    case kReadCalibration:
      return constants(byte_at(command, 7));
    case kConfigIo:
      if (command[6] & 1) timers_ = command.substr(7, 3);
      return extended(kConfigIo, std::string(2, '\0') + timers_ + std::string(5, '\0'));
    case kFeedback:
      // The command Feedback is used only to start the counter.
      zero_ = senses_(kCounterInput, now_ns);
      return extended(kFeedback, std::string(4, '\0'));
    case kStreamConfig:
      return configured(command);
    default:
      return "\xB8\xB8";
  }
}

std::string SimulatedLabjackU6::configured(std::string_view command) {
  const auto reply = [](int error) {
    return extended(kStreamConfig, std::string{static_cast<char>(error), '\0'});
  };
  const std::size_t n = byte_at(command, 6);
  const std::size_t interval = byte_at(command, 12) | std::size_t{byte_at(command, 13)} << 8;
  const std::size_t samples = byte_at(command, 8);
  if (running_) return reply(kStreamActive);
  if (n == 0 || command.size() < 14 + 2 * n || samples < 1 || samples > 25)
    return reply(kBadConfiguration);
  if (interval == 0) return reply(kRateInvalid);
  const double clock_Hz =
      (byte_at(command, 11) & 8 ? 48e6 : 4e6) / (byte_at(command, 11) & 2 ? 256 : 1);
  rate_hz_ = clock_Hz / static_cast<double>(interval);
  samples_per_packet_ = samples;
  list_.clear();
  options_.clear();
  for (std::size_t i = 0; i < n; ++i) {
    list_.push_back(byte_at(command, 14 + 2 * i));
    options_.push_back(byte_at(command, 15 + 2 * i));
  }
  return reply(0);
}

std::int64_t SimulatedLabjackU6::time_of(std::uint64_t sample) const {
  const std::uint64_t whole = sample / list_.size();
  const auto scan = static_cast<double>(whole);
  const auto slot = static_cast<std::int64_t>(sample % list_.size());
  return stream_->start_ns + std::llround(scan * 1e9 / rate_hz_) + slot * kSlot_ns;
}

void SimulatedLabjackU6::take_scans(std::int64_t now_ns) {
  while (stream_ && !gone_) {
    const bool gap =
        faults_.recovery_at >= 0 && stream_->packet == faults_.recovery_at + kRecoveryPackets;
    const std::uint64_t due =
        stream_->next_sample + samples_per_packet_ + (gap ? faults_.dropped * list_.size() : 0);
    if (time_of(due) > now_ns) break;
    gone_ = stream_->packet == faults_.unplug_at;
    if (gone_) break;
    const int number = stream_->packet;
    const std::string packet = encode(packet_of(*stream_));
    if (number != faults_.skip_at)
      packets_.push_back(number == faults_.short_at ? packet.substr(0, kFewBytes) : packet);
    if (number == faults_.stop_at) stream_.reset();
  }
}

// A scan of 0xFFFF is sent instead of the dropped scans. It is between the end of a scan and the
// beginning of the next scan.
StreamData SimulatedLabjackU6::packet_of(Stream& s) {
  StreamData packet;
  packet.counter = static_cast<std::uint8_t>(s.packet);
  const int recovery = faults_.recovery_at < 0 ? -1 : s.packet - faults_.recovery_at;
  if (recovery >= 0 && recovery < kRecoveryPackets) packet.error = kRecovering;
  if (s.packet == faults_.stop_at) packet.error = static_cast<std::uint8_t>(faults_.stop_error);
  const bool gap = recovery == kRecoveryPackets;
  if (gap) packet.error = kRecovered;
  if (gap) packet.dropped = faults_.dropped;
  bool marked = !gap;
  while (packet.samples.size() < samples_per_packet_) {
    const bool between = s.next_sample % list_.size() == 0;
    const bool fits = packet.samples.size() + list_.size() <= samples_per_packet_;
    if (!marked && between && fits) {
      packet.samples.insert(packet.samples.end(), list_.size(), 0xFFFF);
      s.next_sample += faults_.dropped * list_.size();
      marked = true;
    } else {
      packet.samples.push_back(sample(s.next_sample++));
    }
  }
  ++s.packet;
  return packet;
}

std::uint16_t SimulatedLabjackU6::sample(std::uint64_t number) {
  const std::size_t at = number % list_.size();
  const int entry = list_[at];
  const std::int64_t t_ns = time_of(number);
  if (entry == kCapture) return static_cast<std::uint16_t>(captured_ >> 16);
  if (entry >= kTimer0) {
    captured_ = static_cast<std::uint32_t>(std::llround(senses_(kCounterInput, t_ns) - zero_));
    return static_cast<std::uint16_t>(captured_);
  }
  const AinCalibration c = calibration(options_[at] >> 4 & 3);
  const bool differential = (options_[at] & 0x80) != 0;
  const auto ain = static_cast<std::size_t>(entry);
  const double v = senses_(ain, t_ns) - (differential ? senses_(ain + 1, t_ns) : 0);
  const double code = std::round(c.centre + v / (v < 0 ? -c.negative_slope : c.positive_slope));
  return static_cast<std::uint16_t>(std::clamp(code, 0.0, 65535.0));
}

Result<std::unique_ptr<SimulatedDevice>> make_simulated_labjack_u6(SimulatedWiring& wiring) {
  std::vector<SensedInput> sensed = wiring.volts();
  sensed.resize(SimulatedLabjackU6::kCounterInput + 1);
  sensed[SimulatedLabjackU6::kCounterInput] = wiring.counts(kEncoderChannel);
  return std::make_unique<SimulatedLabjackU6>(wiring.senses(std::move(sensed)),
                                              SimulatedLabjackU6::Options{});
}

}  // namespace mdof::drivers::labjack_u6
