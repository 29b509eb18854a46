#include "drivers/mcc_usb1608fs_plus/simulated_mcc_usb1608fs_plus.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mdof::drivers::mcc_usb1608fs_plus {
namespace {

usb::Identity identity_of(const std::string& serial) {
  usb::Identity identity;
  identity.vendor = kVendor;
  identity.product = kProduct;
  identity.manufacturer = "MCC";
  identity.product_name = "USB-1608FS-Plus";
  identity.serial = serial;
  identity.configuration = std::string("\x09\x02\x19\x00\x01\x01\x00\x80\xFA", 9) +
                           std::string("\x09\x04\x00\x00\x01\xFF\x00\x00\x00", 9) +
                           std::string("\x07\x05\x81\x02\x40\x00\x00", 7);
  return identity;
}

double volts_of_code(char code) {
  const auto* range = std::find_if(kRanges.begin(), kRanges.end(), [&](const Range& each) {
    return each.code == static_cast<std::uint8_t>(code);
  });
  return range == kRanges.end() ? 10 : range->volts;
}

const usb::Reply kStalled{usb::Answer::stall, ""};

}  // namespace

SimulatedMccUsb1608fsPlus::SimulatedMccUsb1608fsPlus(Senses senses, const Options& options)
    : senses_(std::move(senses)),
      faults_(options.faults),
      identity_(identity_of(options.serial)),
      calibrations_(options.calibrations),
      memory_(calibration_memory(calibrations_)) {
  if (faults_.running) run_ = Run{{0, pacer_period(1000), 1, 0}, 0, 0};
}

void SimulatedMccUsb1608fsPlus::restart() {
  *this = SimulatedMccUsb1608fsPlus(std::move(senses_), {identity_.serial, calibrations_, {}});
}

usb::Reply SimulatedMccUsb1608fsPlus::control(const usb::Setup& setup, std::string_view out,
                                              std::int64_t now_ns) {
  if (setup.in()) return read_request(setup);
  switch (setup.request) {
    case kScanStart:
      return start(out, now_ns);
    case kScanStop:
      run_.reset();
      return {};
    case kConfig:
      if (out.size() != kInputs || run_) return kStalled;
      ranges_ = out;
      return {};
    case kClearFifo:
      fifo_.clear();
      return {};
    default:
      return kStalled;
  }
}

usb::Reply SimulatedMccUsb1608fsPlus::read_request(const usb::Setup& setup) const {
  const auto given = [&](const std::string& bytes) {
    return usb::Reply{usb::Answer::done, bytes.substr(0, setup.length)};
  };
  switch (setup.request) {
    case kCalibrationMemory:
      return setup.value < memory_.size() ? given(memory_.substr(setup.value)) : kStalled;
    case kStatus:
      return given(status_reply({run_.has_value(), overrun_}));
    case kSerial:
      return given(identity_.serial);
    case kConfig:
      return given(ranges_);
    default:
      return kStalled;
  }
}

usb::Reply SimulatedMccUsb1608fsPlus::start(std::string_view out, std::int64_t now_ns) {
  const auto setup = read_scan_start(out);
  if (!setup || setup->channels == 0 || setup->period == 0 || run_) return kStalled;
  run_ = Run{*setup, now_ns, 0};
  overrun_ = false;
  ++runs_;
  return {};
}

usb::Reply SimulatedMccUsb1608fsPlus::in(std::uint8_t endpoint, std::size_t max_bytes,
                                         std::int64_t now_ns) {
  if (endpoint != kSamplesIn || halted_) return kStalled;
  take_scans(now_ns);
  const bool immediate = run_ && (run_->setup.options & kImmediate) != 0;
  const std::size_t most = faults_.short_packets ? faults_.short_packets : max_bytes;
  std::size_t bytes = std::min(most, fifo_.size());
  if (bytes < most && !(immediate && bytes > 0)) {
    const bool may_stall = run_ && (faults_.stalls || !(run_->setup.options & kNoStall));
    halted_ = overrun_ && may_stall;
    return halted_ ? kStalled : usb::Reply{usb::Answer::not_yet, ""};
  }
  usb::Reply reply{usb::Answer::done, fifo_.substr(0, bytes)};
  fifo_.erase(0, bytes);
  return reply;
}

usb::Reply SimulatedMccUsb1608fsPlus::out(std::uint8_t /*endpoint*/, std::string_view /*bytes*/,
                                          std::int64_t /*now_ns*/) {
  return kStalled;
}

void SimulatedMccUsb1608fsPlus::clear_halt(std::uint8_t endpoint) {
  if (endpoint == kSamplesIn) halted_ = false;
}

void SimulatedMccUsb1608fsPlus::take_scans(std::int64_t now_ns) {
  while (run_ && !gone_) {
    if (apply_due_fault()) continue;
    const double age_s = static_cast<double>(run_->next + 1) / rate_of(run_->setup.period);
    const std::int64_t t_ns = run_->start_ns + std::llround(age_s * 1e9);
    const bool silent =
        faults_.silent_at >= 0 && run_->next >= static_cast<std::uint64_t>(faults_.silent_at);
    if (t_ns > now_ns || silent) return;
    sample(t_ns);
    ++run_->next;
  }
}

// Returns whether a fault has changed the next scan.
bool SimulatedMccUsb1608fsPlus::apply_due_fault() {
  const auto is_due = [&](std::int64_t scan) {
    return scan >= 0 && static_cast<std::int64_t>(run_->next) >= scan;
  };
  if (is_due(faults_.unplug_at)) return gone_ = true;
  if (is_due(faults_.drop_at)) {
    faults_.drop_at = -1;
    ++run_->next;
    return true;
  }
  if (!is_due(faults_.overrun_at) || overrun_) return false;
  overrun_ = true;
  run_->next += faults_.overrun;
  return true;
}

void SimulatedMccUsb1608fsPlus::sample(std::int64_t t_ns) {
  for (std::size_t input = 0; input < kInputs; ++input) {
    if (!(run_->setup.channels >> input & 1)) continue;
    const double range_v = volts_of_code(ranges_[input]);
    const double wanted = senses_(input, t_ns) / range_v * 32768 + 32768;
    const Calibration& c = calibrations_[input];
    const double raw = std::round((wanted - c.offset) / c.slope);
    const auto code = static_cast<std::uint16_t>(std::clamp(raw, 0.0, 65535.0));
    fifo_ += static_cast<char>(code & 0xFF);
    fifo_ += static_cast<char>(code >> 8);
  }
}

Result<std::unique_ptr<SimulatedDevice>> make_simulated_mcc_usb1608fs_plus(
    SimulatedWiring& wiring) {
  return std::make_unique<SimulatedMccUsb1608fsPlus>(wiring.senses(wiring.volts()),
                                                     SimulatedMccUsb1608fsPlus::Options{});
}

}  // namespace mdof::drivers::mcc_usb1608fs_plus
