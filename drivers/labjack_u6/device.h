// A U6 without one: its command pipe (port 0) and its stream's pipe (port 1), as USB carries them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "drivers/labjack_u6/protocol.h"
#include "drivers/simulated_device.h"

namespace mdof::drivers::labjack_u6 {

// What may go wrong; packets of the stream are counted from 0, -1: never.
struct Faults {
  bool deaf = false;            // every command is answered B8 B8
  bool wrong_checksum = false;  // of every reply
  int recovery_at = -1;         // three packets have error 59, then 60 reports `dropped` scans
  std::uint16_t dropped = 0;
  int stop_at = -1;  // this packet has `stop_error` and is the last
  int stop_error = kScanOverlap;
  int skip_at = -1;        // this packet is not sent
  int short_at = -1;       // of this packet only 20 bytes come
  int unplug_at = -1;      // the device is gone before this packet
  bool streaming = false;  // a stream runs already at the start (of a host that died)
};

// Senses: inputs 0 ... 13 are AIN0 ... AIN13 in volts, input 14 the counts of timers 0 and 1.
// exchange() of port 0 takes one transfer, a whole command. Entries of a scan are 10 us apart.
class Device final : public SimulatedDevice {
 public:
  static constexpr std::size_t kCounterInput = kAins;
  static constexpr std::uint32_t kSerial = 360012345;

  Device(Senses senses, const Faults& faults);

  std::vector<Port> ports() const override { return {{"command", 0}, {"stream", 0}}; }
  void opened(std::size_t /*port*/, int /*client*/, std::int64_t /*now_ns*/) override {}
  void closed(std::size_t /*port*/, int /*client*/) override {}
  std::string exchange(std::size_t port, int client, std::string_view received,
                       std::int64_t now_ns) override;
  bool hangs_up(std::size_t port, int client) override;

  void set_faults(const Faults& faults) { faults_ = faults; }
  static AinCalibration calibration(std::size_t gain);

 private:
  struct Stream {
    std::int64_t start_ns = 0;      // of scan 0
    std::uint64_t next_sample = 0;  // of all samples taken, dropped ones included
    int packet = 0;
  };
  std::string answer(std::string_view command, std::int64_t now_ns);
  std::string answer_normal(std::string_view command, std::int64_t now_ns);
  std::string answer_extended(std::string_view command);
  std::string configured(std::string_view command);
  std::string stream_packets(std::int64_t now_ns);
  StreamData packet_of(Stream& stream);
  std::uint16_t sample(std::uint64_t number);
  std::int64_t time_of(std::uint64_t sample) const;

  Senses senses_;
  Faults faults_;
  double rate_hz_ = 0;
  std::size_t samples_per_packet_ = 25;
  std::vector<int> list_;
  std::vector<std::size_t> gains_;  // of the entries
  std::optional<Stream> stream_;
  std::uint32_t captured_ = 0;
  bool running_ = false, gone_ = false;
};

}  // namespace mdof::drivers::labjack_u6
