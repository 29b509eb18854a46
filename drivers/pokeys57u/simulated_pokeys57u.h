// A simulated PoKeys57U, as a program sees it on the USB: a keyboard, the HID interface of the
// encoders, a joystick.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <string>

#include "drivers/pokeys57u/protocol.h"
#include "drivers/simulated_wiring.h"
#include "drivers/usb/simulated_usb.h"

namespace mdof::drivers::pokeys57u {

// Senses: inputs 0 ... 24 are encoders 1 ... 25, 25 the ultra-fast one, in counts; 26 ... 32 the
// analogue inputs in volts. A request is answered a millisecond later.
class SimulatedPokeys57u final : public usb::SimulatedUsb {
 public:
  static constexpr std::uint8_t kIn = 0x82, kOut = 0x02;

  // What may go wrong; replies are counted from 0, -1: never.
  struct Faults {
    int wrong_id_at = -1;      // this reply is preceded by the one before it, with its number
    int bad_checksum_at = -1;  // of so many replies from this one on
    int bad_checksums = 1;
    int late_at = -1;  // this reply comes so much later than the others
    std::int64_t late_ns = 50'000'000;
    int mute_at = -1;  // so many requests from this one on are not answered
    int mutes = 1;
    int index_at = -1;    // before this reply the index sets all counts to 0
    int restart_at = -1;  // before this reply it was without power
    int short_at = -1;    // of this reply 20 bytes come
    int unplug_at = -1;   // it is gone instead
    bool deaf_to_options = false;
  };
  struct Options {
    std::uint32_t serial = 12345;
    std::string usb_serial = {};      // empty: "2." and the number
    std::int64_t uptime_ms = 60'000;  // when it is first asked
    std::int64_t count_offset = 0;    // of all counts
    bool old_board = false;           // states its number as boards before the PoKeys58 did
    Faults faults = {};
  };
  SimulatedPokeys57u(Senses senses, Options options);

  const usb::Identity& identity() const override { return identity_; }
  usb::Reply control(const usb::Setup& setup, std::string_view out, std::int64_t now_ns) override;
  usb::Reply in(std::uint8_t endpoint, std::size_t max_bytes, std::int64_t now_ns) override;
  usb::Reply out(std::uint8_t endpoint, std::string_view bytes, std::int64_t now_ns) override;
  void clear_halt(std::uint8_t) override {}
  bool gone() const override { return gone_; }

  // Replies are counted from 0 again.
  void set_faults(const Faults& faults) {
    options_.faults = faults;
    replies_ = 0;
  }
  int requests() const { return requests_; }  // with a right checksum

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

// As a plan of mdof-simulate has it. Counts: of the encoder at the first input, where none is
// given.
Result<std::unique_ptr<SimulatedDevice>> make_simulated_pokeys57u(SimulatedWiring& wiring);

}  // namespace mdof::drivers::pokeys57u
