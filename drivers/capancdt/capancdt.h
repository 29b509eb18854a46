// Driver of a capaNCDT 6200 controller. Its channels are the probes of the rig, in µm.
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "drivers/capancdt/controller.h"
#include "drivers/capancdt/frame_counter.h"
#include "drivers/capancdt/options.h"
#include "drivers/capancdt/protocol.h"
#include "drivers/capancdt/rate_watch.h"
#include "drivers/clock/device_clock.h"
#include "drivers/driver.h"
#include "drivers/io/byte_stream.h"

namespace mdof::drivers::capancdt {

// State of the data port since open().
struct Health {
  std::uint64_t lost = 0;        // number of lost frames
  std::uint64_t duplicates = 0;  // number of packets that arrived twice
  std::uint64_t skipped = 0;     // number of bytes that belong to no packet
  // Unit that the counter in the packets counts; nullopt: not known yet.
  std::optional<CounterUnit> counter;
  ClockState clock;
};

// Thread-bound. Errors of read(): silence; disconnection; a jump of the counter; a frame rate that
// differs from the rate that the controller states; invalid data. After an error, read() returns
// the same error until open() is called.
class Capancdt final : public Driver {
 public:
  explicit Capancdt(Options options);

  DeviceInfo info() const override;
  const DeviceClock* clock() const override;
  Status open() override;
  Result<ReadState> read(SampleBlock& block, std::chrono::milliseconds timeout) override;

  Health health() const;

 private:
  // State of one connection to the data port. open() begins a new session.
  struct Session {
    Setup setup;
    ByteStream data;
    PacketParser parser;
    FrameCounter counter;
    DeviceClock clock;
    RateWatch rate;
    std::deque<PlacedPacket> waiting;  // packets that are numbered but not returned yet
    std::chrono::steady_clock::time_point last_packet_time;
    std::optional<std::int64_t> newest_frame;  // newest frame whose time was added to the clock
    // Host time at which the first frame was added to the clock.
    std::optional<std::int64_t> first_ns;
    bool warm = false;  // Options::warm_up has elapsed
    // read() returns this error after the scans that precede the error.
    std::optional<Error> failed;
  };
  Status receive(std::chrono::milliseconds timeout);
  Result<bool> receive_all(std::chrono::milliseconds timeout, bool& came);
  Status place_packets(std::chrono::steady_clock::time_point received);
  Status update_clock(std::int64_t received_ns, bool all);
  Status check_silence() const;
  tl::unexpected<Error> with_device_name(const Error& error) const;
  void fill_block(SampleBlock& block);
  void append(SampleBlock& block, const PlacedPacket& placed);
  void append_value(SampleBlock& block, std::size_t channel, std::optional<std::int32_t> raw) const;

  Options options_;
  std::vector<Channel> channels_;
  std::unique_ptr<Session> session_;
};

}  // namespace mdof::drivers::capancdt
