// A simulated U6: the USB side of the device.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "drivers/labjack_u6/protocol.h"
#include "drivers/simulated_wiring.h"
#include "drivers/usb/simulated_usb.h"

namespace mdof::drivers::labjack_u6 {

// Senses: inputs 0 ... 13 are AIN0 ... AIN13 in V, input 14 is the count of timers 0 and 1. Entries
// of a scan are 10 us apart.
class SimulatedLabjackU6 final : public usb::SimulatedUsb {
 public:
  // Possible faults; stream packets are counted from 0; -1: never.
  struct Faults {
    bool deaf = false;            // every command gets the reply B8 B8
    bool wrong_checksum = false;  // in every reply
    int recovery_at = -1;         // three packets have error 59, then 60 reports `dropped` scans
    std::uint16_t dropped = 0;
    int stop_at = -1;  // this packet has `stop_error` and is the last
    int stop_error = kScanOverlap;
    int skip_at = -1;        // this packet is not sent
    int short_at = -1;       // only 20 bytes of this packet arrive
    int unplug_at = -1;      // the device is unplugged before this packet
    bool streaming = false;  // a stream already runs at the start (left by a host that crashed)
    bool nameless = false;   // no serial number in its descriptor
  };
  static constexpr std::size_t kCounterInput = kAins;
  static constexpr std::uint32_t kSerial = 360012345;

  struct Options {
    std::uint32_t serial = kSerial;
    Faults faults = {};
  };
  SimulatedLabjackU6(Senses senses, const Options& options);

  const usb::Identity& identity() const override { return identity_; }
  usb::Reply control(const usb::Setup& setup, std::string_view out, std::int64_t now_ns) override;
  usb::Reply in(std::uint8_t endpoint, std::size_t max_bytes, std::int64_t now_ns) override;
  usb::Reply out(std::uint8_t endpoint, std::string_view bytes, std::int64_t now_ns) override;
  void clear_halt(std::uint8_t /*endpoint*/) override {}
  bool gone() const override { return gone_; }

  void set_faults(const Faults& faults) { faults_ = faults; }
  void restart();  // power is switched on again: default state
  static AinCalibration calibration(std::size_t gain);

 private:
  struct Stream {
    std::int64_t start_ns = 0;      // of scan 0
    std::uint64_t next_sample = 0;  // number of samples taken, including dropped samples
    int packet = 0;
  };
  std::string answer(std::string_view command, std::int64_t now_ns);
  std::string answer_normal(std::string_view command, std::int64_t now_ns);
  std::string answer_extended(std::string_view command, std::int64_t now_ns);
  std::string identity_body() const;
  std::string configured(std::string_view command);
  void take_scans(std::int64_t now_ns);
  usb::Reply stream_in(std::size_t max_bytes);
  StreamData packet_of(Stream& stream);
  std::uint16_t sample(std::uint64_t number);
  std::int64_t time_of(std::uint64_t sample) const;

  Senses senses_;
  Faults faults_;
  std::uint32_t serial_;
  usb::Identity identity_;
  std::deque<std::string> replies_, packets_;  // not read yet
  double rate_hz_ = 0;
  std::size_t samples_per_packet_ = 25;
  std::vector<int> list_;
  std::vector<std::uint8_t> options_;  // gain and differential bit of the entries
  std::optional<Stream> stream_;
  std::string timers_ = std::string(3, '\0');  // number of timers, counters, pin offset
  double zero_ = 0;                            // of the counter
  std::uint32_t captured_ = 0;
  bool running_ = false, gone_ = false;
};

// Makes the twin from a plan of mdof-simulate. Volts at AIN0 ..., counts of the encoder at timers 0
// and 1.
Result<std::unique_ptr<SimulatedDevice>> make_simulated_labjack_u6(SimulatedWiring& wiring);

}  // namespace mdof::drivers::labjack_u6
