#include "drivers/pokeys57u/simulated_pokeys57u.h"

#include <algorithm>
#include <cmath>

#include "schema/sample.h"

namespace mdof::drivers::pokeys57u {
namespace {

constexpr std::int64_t kAnswer_ns = 1'000'000;
constexpr std::size_t kFewBytes = 20;
constexpr std::uint8_t kHidSetReport = 0x09, kHidSetIdle = 0x0A, kHidSetProtocol = 0x0B;

std::string bytes_of(std::initializer_list<int> values) {
  std::string bytes;
  for (const int value : values) bytes += static_cast<char>(value);
  return bytes;
}

// HID 1.11, appendix B.1: a keyboard of the boot protocol, without LEDs.
std::string keyboard_report() {
  return bytes_of({0x05, 0x01, 0x09, 0x06, 0xA1, 0x01, 0x05, 0x07, 0x19, 0xE0, 0x29, 0xE7,
                   0x15, 0x00, 0x25, 0x01, 0x75, 0x01, 0x95, 0x08, 0x81, 0x02, 0x95, 0x01,
                   0x75, 0x08, 0x81, 0x01, 0x95, 0x06, 0x75, 0x08, 0x15, 0x00, 0x25, 0x65,
                   0x05, 0x07, 0x19, 0x00, 0x29, 0x65, 0x81, 0x00, 0xC0});
}
// 64 bytes in each direction, with a vendor-defined usage page.
std::string vendor_report() {
  return bytes_of({0x06, 0x00, 0xFF, 0x09, 0x01, 0xA1, 0x01, 0x15, 0x00,
                   0x26, 0xFF, 0x00, 0x75, 0x08, 0x95, 0x40, 0x09, 0x02,
                   0x81, 0x02, 0x95, 0x40, 0x09, 0x03, 0x91, 0x02, 0xC0});
}
// Two axes and eight buttons.
std::string joystick_report() {
  return bytes_of({0x05, 0x01, 0x09, 0x04, 0xA1, 0x01, 0x15, 0x81, 0x25, 0x7F, 0x75, 0x08, 0x95,
                   0x02, 0x09, 0x30, 0x09, 0x31, 0x81, 0x02, 0x05, 0x09, 0x19, 0x01, 0x29, 0x08,
                   0x15, 0x00, 0x25, 0x01, 0x75, 0x01, 0x95, 0x08, 0x81, 0x02, 0xC0});
}

std::string endpoint(int address, int bytes) {
  return bytes_of({7, 5, address, 3, bytes, 0, 1});  // interrupt, every millisecond
}
std::string interface(int number, int endpoints, int subclass, int protocol,
                      const std::string& report) {
  return bytes_of({9, 4, number, 0, endpoints, 3, subclass, protocol, 0}) +
         bytes_of({9, 0x21, 0x11, 0x01, 0, 1, 0x22, static_cast<int>(report.size()), 0});
}

std::string configuration() {
  std::string all = interface(0, 1, 1, 1, keyboard_report()) + endpoint(0x81, 8);
  all += interface(1, 2, 0, 0, vendor_report()) + endpoint(SimulatedPokeys57u::kIn, 64) +
         endpoint(SimulatedPokeys57u::kOut, 64);
  all += interface(2, 1, 0, 0, joystick_report()) + endpoint(0x83, 3);
  const int size = static_cast<int>(all.size()) + 9;
  return bytes_of({9, 2, size & 0xFF, size >> 8, 3, 1, 0, 0x80, 50}) + all;
}

}  // namespace

SimulatedPokeys57u::SimulatedPokeys57u(Senses senses, Options options)
    : senses_(std::move(senses)), options_(std::move(options)) {
  identity_.vendor = kVendor;
  identity_.product = kProduct;
  identity_.manufacturer = "PoLabs";
  identity_.product_name = "PoKeys57U";
  identity_.serial =
      options_.usb_serial.empty() ? "2." + std::to_string(options_.serial) : options_.usb_serial;
  identity_.configuration = configuration();
  identity_.hid_reports = {keyboard_report(), vendor_report(), joystick_report()};
}

usb::Reply SimulatedPokeys57u::control(const usb::Setup& setup, std::string_view out,
                                       std::int64_t now_ns) {
  switch (setup.request) {
    case kHidSetReport:  // for hosts that do not use the OUT endpoint
      return setup.index == kInterface ? this->out(kOut, out, now_ns) : usb::Reply{};
    case kHidSetIdle:
    case kHidSetProtocol:
      return {};
    default:
      return {usb::Answer::stall, ""};
  }
}

usb::Reply SimulatedPokeys57u::in(std::uint8_t endpoint, std::size_t max_bytes,
                                  std::int64_t now_ns) {
  const auto due = std::find_if(sent_.begin(), sent_.end(),
                                [&](const Sent& sent) { return sent.due_ns <= now_ns; });
  if (gone_ || endpoint != kIn || due == sent_.end()) return {usb::Answer::not_yet, ""};
  usb::Reply reply{usb::Answer::done, due->report.substr(0, max_bytes)};
  sent_.erase(due);
  return reply;
}

usb::Reply SimulatedPokeys57u::out(std::uint8_t endpoint, std::string_view bytes,
                                   std::int64_t now_ns) {
  if (powered_ns_ == INT64_MIN) powered_ns_ = now_ns - options_.uptime_ms * 1'000'000;
  if (const auto asked = unwrap(Way::request, bytes); asked && endpoint == kOut && !gone_)
    take(*asked, now_ns);
  return {};
}

void SimulatedPokeys57u::take(const Frame& asked, std::int64_t now_ns) {
  const Faults& f = options_.faults;
  const int number = replies_++;
  const auto within = [number](int from, int count) {
    return from >= 0 && number >= from && number < from + count;
  };
  ++requests_;
  if (number == f.unplug_at) gone_ = true;
  if (number == f.index_at) begin_counts(now_ns);
  if (number == f.restart_at) {
    powered_ns_ = now_ns;
    begin_counts(now_ns);
  }
  if (gone_ || within(f.first_unanswered, f.unanswered_requests)) return;
  std::string report = wrap(Way::reply, answer(asked, now_ns));
  std::int64_t due_ns = now_ns + kAnswer_ns + f.latency_ns;
  if (number == f.wrong_id_at) sent_.push_back({due_ns, last_report_});
  if (number == f.late_at) due_ns += f.late_ns;
  last_report_ = report;
  if (within(f.bad_checksum_at, f.bad_checksums)) report[7] = static_cast<char>(report[7] ^ 0x55);
  if (number == f.short_at) report.resize(kFewBytes);
  sent_.push_back({due_ns, report});
}

Frame SimulatedPokeys57u::answer(const Frame& asked, std::int64_t now_ns) {
  Frame reply;
  reply.command = asked.command;
  reply.id = asked.id;
  switch (asked.command) {
    case kDeviceData:
      answer_identity(reply);
      break;
    case kTick:
      set_tick(reply, static_cast<std::uint32_t>((now_ns - powered_ns_) / 1'000'000));
      break;
    case kEncoderValues:
      set_counts(reply, counts(asked.parameter[0] & 1, now_ns));
      break;
    case kEncoderOptions:
      if (asked.parameter[0] == 1 && !options_.faults.ignores_options)
        encoder_options_ = asked.data;
      reply.data = encoder_options_;
      break;
    case kAnalogue: {
      Codes codes;
      for (std::size_t i = 0; i < kAnalogues; ++i)
        codes[i] = static_cast<std::uint16_t>(std::clamp<std::int64_t>(
            std::llround(senses_(kCounters + i, now_ns) / kAnalogueTop_V * kAnalogueTop), 0,
            kAnalogueTop));
      set_analogue(reply, codes);
      break;
    }
    default:
      break;
  }
  return reply;
}

void SimulatedPokeys57u::answer_identity(Frame& reply) const {
  reply.parameter[2] = 0x32;  // firmware 4.2.19
  reply.parameter[3] = 19;
  if (options_.old_board) {
    reply.parameter[0] = static_cast<std::uint8_t>(options_.serial >> 8);
    reply.parameter[1] = static_cast<std::uint8_t>(options_.serial);
    return;
  }
  for (std::size_t i = 0; i < 4; ++i) {
    reply.data[i] = static_cast<std::uint8_t>("PK58"[i]);
    reply.data[4 + i] = static_cast<std::uint8_t>(options_.serial >> 8 * i);
  }
  reply.data[10] = 28;  // a PoKeys57U
}

std::int64_t SimulatedPokeys57u::count(std::size_t input, std::int64_t now_ns) const {
  return std::llround(senses_(input, now_ns)) + options_.count_offset;
}

Counts SimulatedPokeys57u::counts(std::size_t block, std::int64_t now_ns) const {
  Counts counts{};
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const std::size_t input = block * kCountersPerBlock + i;
    const std::int64_t whole = count(input, now_ns) - zero_[input];
    counts[i] = static_cast<std::int32_t>(static_cast<std::uint32_t>(whole));
  }
  return counts;
}

void SimulatedPokeys57u::begin_counts(std::int64_t now_ns) {
  for (std::size_t i = 0; i < kCounters; ++i) zero_[i] = count(i, now_ns);
}

Result<std::unique_ptr<SimulatedDevice>> make_simulated_pokeys57u(SimulatedWiring& wiring) {
  SimulatedPokeys57u::Options options;
  options.serial = static_cast<std::uint32_t>(wiring.table().integer("serial", options.serial));
  std::vector<SensedInput> sensed;
  for (const std::string& input : wiring.inputs()) sensed.push_back(wiring.counts(input));
  if (sensed.empty()) sensed.push_back(wiring.counts(kEncoderChannel));
  return std::make_unique<SimulatedPokeys57u>(wiring.senses(std::move(sensed)), options);
}

}  // namespace mdof::drivers::pokeys57u
