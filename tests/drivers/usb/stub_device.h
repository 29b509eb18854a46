// A simulated device that returns the bytes that it receives.
#pragma once

#include <deque>
#include <string>

#include "drivers/usb/simulated_usb.h"

namespace mdof::drivers::usb {

// Endpoints and requests:
// - bulk OUT 0x01 receives bytes, and IN 0x81 returns them
// - IN 0x82 sends `stream`
// - vendor request 1 returns 4 bytes, request 2 accepts bytes
// - all other requests stall
class StubDevice final : public SimulatedUsb {
 public:
  explicit StubDevice(const std::string& serial) {
    identity_.vendor = 0x1209;
    identity_.product = 0x0001;
    identity_.serial = serial;
    identity_.configuration = std::string("\x09\x02\x27\x00\x01\x01\x00\x80\x32", 9) +
                              std::string("\x09\x04\x00\x00\x03\xFF\x00\x00\x00", 9) +
                              std::string("\x07\x05\x01\x02\x40\x00\x00", 7) +
                              std::string("\x07\x05\x81\x02\x40\x00\x00", 7) +
                              std::string("\x07\x05\x82\x02\x40\x00\x00", 7);
  }
  const Identity& identity() const override { return identity_; }
  Reply control(const Setup& setup, std::string_view out, std::int64_t /*now_ns*/) override {
    if (setup.request == 1) return {Answer::done, std::string("abcd").substr(0, setup.length)};
    if (setup.request != 2) return {Answer::stall, ""};
    reported = out;
    return {};
  }
  Reply in(std::uint8_t endpoint, std::size_t most, std::int64_t /*now_ns*/) override {
    if (halted == endpoint) return {Answer::stall, ""};
    std::deque<std::string>& from = endpoint == 0x81 ? echoes : stream;
    if (from.empty()) return {Answer::not_yet, ""};
    std::string bytes = from.front();
    from.pop_front();
    return {Answer::done, too_long ? std::string(most + 1, 'x') : bytes};
  }
  Reply out(std::uint8_t /*endpoint*/, std::string_view bytes, std::int64_t /*now_ns*/) override {
    if (mute) return {Answer::not_yet, ""};
    echoes.emplace_back(bytes);
    return {};
  }
  void clear_halt(std::uint8_t endpoint) override {
    if (halted == endpoint) halted = 0;
  }
  bool gone() const override { return gone_; }

  std::deque<std::string> echoes, stream;
  std::string reported;
  std::uint8_t halted = 0;
  bool mute = false, too_long = false, gone_ = false;

 private:
  Identity identity_;
};

}  // namespace mdof::drivers::usb
