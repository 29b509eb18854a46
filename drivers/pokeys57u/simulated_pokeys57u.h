// A simulated PoKeys57U. It implements the USB interface of the device: a keyboard, the HID
// interface of the encoders, and a joystick.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <string>

#include "drivers/pokeys57u/protocol.h"
#include "drivers/simulated_wiring.h"
#include "drivers/usb/simulated_usb.h"

namespace mdof::drivers::pokeys57u {

// Senses: inputs 0 ... 24 are encoders 1 ... 25 in counts; input 25 is the ultra-fast encoder in
// counts; inputs 26 ... 32 are the analogue inputs in V. The device replies to a request after 1
// ms.
class SimulatedPokeys57u final : public usb::SimulatedUsb {
 public:
  static constexpr std::uint8_t kIn = 0x82, kOut = 0x02;

  // Possible faults. A member `..._at` is the number of a reply, from 0; -1: never.
  struct Faults {
    // Before this reply, the previous reply with its old number is sent again.
    int wrong_id_at = -1;
    int bad_checksum_at = -1;  // first of `bad_checksums` replies with a wrong checksum
    int bad_checksums = 1;
    int late_at = -1;  // this reply is sent late_ns later
    std::int64_t late_ns = 50'000'000;
    std::int64_t latency_ns = 0;  // every reply is sent later by this time
    int first_unanswered = -1;    // first of `unanswered_requests` requests that get no reply
    int unanswered_requests = 1;
    int index_at = -1;    // before this reply the index signal sets all counts to 0
    int restart_at = -1;  // before this reply the power of the device fails
    int short_at = -1;    // only 20 bytes of this reply arrive
    int unplug_at = -1;   // the device is unplugged instead of sending this reply
    bool ignores_options = false;
  };
  struct Options {
    std::uint32_t serial = 12345;
    std::string usb_serial = {};      // empty: the string is "2." and the serial number
    std::int64_t uptime_ms = 60'000;  // uptime at the first request
    std::int64_t count_offset = 0;    // added to all counts
    bool old_board = false;  // the device states its serial number like boards before the PoKeys58
    Faults faults = {};
  };
  SimulatedPokeys57u(Senses senses, Options options);

  const usb::Identity& identity() const override { return identity_; }
  usb::Reply control(const usb::Setup& setup, std::string_view out, std::int64_t now_ns) override;
  usb::Reply in(std::uint8_t endpoint, std::size_t max_bytes, std::int64_t now_ns) override;
  usb::Reply out(std::uint8_t endpoint, std::string_view bytes, std::int64_t now_ns) override;
  void clear_halt(std::uint8_t) override {}
  bool gone() const override { return gone_; }

  // Replaces the faults. The replies are then counted from 0 again.
  void set_faults(const Faults& faults) {
    options_.faults = faults;
    replies_ = 0;
  }
  int requests() const { return requests_; }  // number of requests with a valid checksum

 private:
  struct Sent {
    std::int64_t due_ns;
    std::string report;
  };
  void take(const Frame& asked, std::int64_t now_ns);
  Frame answer(const Frame& asked, std::int64_t now_ns);
  void answer_identity(Frame& reply) const;
  Counts counts(std::size_t block, std::int64_t now_ns) const;
  std::int64_t count(std::size_t input, std::int64_t now_ns) const;
  void begin_counts(std::int64_t now_ns);

  Senses senses_;
  Options options_;
  usb::Identity identity_;
  std::array<std::int64_t, kCounters> zero_{};
  std::array<std::uint8_t, kDataBytes> encoder_options_{};
  std::int64_t powered_ns_ = INT64_MIN;
  std::deque<Sent> sent_;
  std::string last_report_;
  int replies_ = 0, requests_ = 0;
  bool gone_ = false;
};

// Makes the twin from a plan of mdof-simulate. It counts the listed encoders; default: the encoder
// of the machine, at the first input.
Result<std::unique_ptr<SimulatedDevice>> make_simulated_pokeys57u(SimulatedWiring& wiring);

}  // namespace mdof::drivers::pokeys57u
