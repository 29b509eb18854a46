// A capaNCDT 6200 controller, its probes as channels of the rig, in µm.
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

// What happened on the data port since open().
struct Health {
  std::uint64_t lost = 0;              // frames
  std::uint64_t duplicates = 0;        // packets
  std::uint64_t skipped = 0;           // bytes that were no packet
  std::optional<CounterUnit> counter;  // what it counts; none: not known yet
  ClockState clock;
};

// Thread-bound. Errors of read(): silence, disconnection, a counter that jumped, frames at another
// rate than the controller says, garbage. Each is final until open().
class Capancdt final : public Driver {
 public:
  explicit Capancdt(Options options);

  DeviceInfo info() const override;
  Status open() override;
  Result<ReadState> read(SampleBlock& block, std::chrono::milliseconds timeout) override;

  Health health() const;

 private:
  // Of one connection; a new one begins without memory.
  struct Session {
    Setup setup;
    ByteStream data;
    PacketParser parser;
    FrameCounter counter;
    DeviceClock clock;
    RateWatch rate;
    std::deque<PlacedPacket> waiting;  // placed, not yet handed out
    std::chrono::steady_clock::time_point heard;
    std::optional<std::int64_t> newest_frame, first_ns;  // that the clock was told of; and when
    bool warm = false;                                   // scans may be handed out
    std::optional<Error> failed;  // to be told when all that came before is handed out
  };
  Status receive(std::chrono::milliseconds timeout);
  Result<bool> receive_all(std::chrono::milliseconds timeout, bool& came);
  Status place_packets(std::chrono::steady_clock::time_point received);
  Status tell_time(std::int64_t received_ns, bool all);
  Status check_silence() const;
  tl::unexpected<Error> lasting(const Error& error) const;
  void hand_out(SampleBlock& block);
  void append(SampleBlock& block, const PlacedPacket& placed);
  void append_value(SampleBlock& block, std::size_t channel, std::optional<std::int32_t> raw) const;

  Options options_;
  std::vector<Channel> channels_;
  std::unique_ptr<Session> session_;
};

}  // namespace mdof::drivers::capancdt
