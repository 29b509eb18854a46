// A simulated U6. It implements the USB interface of the device.
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

// Senses: inputs 0 ... 13 are AIN0 ... AIN13 in V; input 14 is the count of timers 0 and 1. In a
// scan, successive entries of the scan list are sampled 10 us apart.
class SimulatedLabjackU6 final : public usb::SimulatedUsb {
 public:
  // Possible faults. A member `..._at` is the number of a stream packet, from 0; -1: never.
  struct Faults {
    bool deaf = false;            // every command is answered with B8 B8
    bool wrong_checksum = false;  // every reply has a wrong checksum
    // Three packets have error 59, then a packet with error 60 reports `dropped` scans.
    int recovery_at = -1;
    std::uint16_t dropped = 0;
    int stop_at = -1;  // this packet has `stop_error` and is the last packet
    int stop_error = kScanOverlap;
    int skip_at = -1;    // this packet is not sent
    int short_at = -1;   // only 20 bytes of this packet arrive
    int unplug_at = -1;  // the device is unplugged before this packet
    // A stream is already running at the start, as after a crash of the host.
    bool streaming = false;
    bool nameless = false;  // the USB descriptor contains no serial number
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
  void restart();  // power is switched off and on: all settings have their defaults
  static AinCalibration calibration(std::size_t gain);

 private:
  struct Stream {
    std::int64_t start_ns = 0;  // time of scan 0
    // Number of samples that were taken; dropped samples are counted too.
    std::uint64_t next_sample = 0;
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
  std::deque<std::string> replies_, packets_;  // data that the host has not read yet
  double rate_hz_ = 0;
  std::size_t samples_per_packet_ = 25;
  std::vector<int> list_;
  std::vector<std::uint8_t> options_;  // for each entry: gain and differential bit
  std::optional<Stream> stream_;
  std::string timers_ = std::string(3, '\0');  // number of timers, counter flags, pin offset
  double zero_ = 0;                            // zero of the counter
  std::uint32_t captured_ = 0;
  bool running_ = false, gone_ = false;
};

// Makes the twin from a plan of mdof-simulate. The probes are at AIN0 ..., in V. The counts of the
// encoder are at timers 0 and 1.
Result<std::unique_ptr<SimulatedDevice>> make_simulated_labjack_u6(SimulatedWiring& wiring);

}  // namespace mdof::drivers::labjack_u6
