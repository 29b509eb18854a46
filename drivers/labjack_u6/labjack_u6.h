// LabJack U6 over USB: amplifier outputs and one quadrature encoder in one hardware-timed scan.
//
// The device stamps nothing: scan k was taken at the start + k / rate by its own clock, k counted
// with the scans that it says it dropped. DeviceClock brings that to the host's clock from the
// arrivals of transfers. Inside a scan the inputs follow each other by some 10 us; the scan has one
// time.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "drivers/clock/device_clock.h"
#include "drivers/counter/unwrap.h"
#include "drivers/driver.h"
#include "drivers/labjack/count_guard.h"
#include "drivers/labjack_u6/settings.h"

namespace mdof::drivers::labjack_u6 {

// Thread-bound. Channels: Unit::volt of an AIN, Unit::um of the counter.
//
// The counter is started, from 0, when this object opens the device for the first time and left
// running over a re-open. If it had stopped (the U6 was unplugged), or went faster than it can
// count, its zero is lost: from then on its values are Quality::suspect, until it is
// trusted again.
class LabjackU6 final : public Driver {
 public:
  explicit LabjackU6(Settings settings);
  ~LabjackU6() override;  // stops the stream

  DeviceInfo info() const override;
  const DeviceClock* clock() const override { return &clock_; }
  Status open() override;
  Result<ReadState> read(SampleBlock& block, std::chrono::milliseconds timeout) override;
  void trust_count() override;

 private:
  void close();
  Status start();
  Status take_up_counter();
  Status next_scans(std::chrono::milliseconds timeout);
  Status receive(std::chrono::milliseconds timeout);
  Status why_silent();
  Status take(const usb::InStream::Chunk& chunk);
  void fill_block(SampleBlock& block);
  void append(SampleBlock& block, const Scan& scan);
  std::uint64_t lost_while_closed(std::int64_t time_ns) const;
  std::string place() const;

  Settings settings_;
  std::vector<Entry> list_;
  StreamClock scan_clock_;
  std::size_t samples_;  // of a packet
  std::string description_;
  std::vector<Channel> channels_;
  std::optional<usb::Handle> handle_;
  std::optional<usb::InStream> stream_;
  PacketLine line_;
  std::array<AinCalibration, 4> calibrations_;  // of the gains

  DeviceClock clock_;               // ticks are scans
  std::int64_t last_chunk_ns_ = 0;  // host time; at first of the start
  std::vector<Scan> scans_;         // received
  std::size_t handed_out_ = 0;      // of them
  Status broken_;                   // the error that ended the stream

  Unwrap count_{32, true};
  bool counted_ = false;           // the counter was started by this object
  bool zero_lost_ = false;         // of the counter
  labjack::CountGuard guard_;      // of the counter
  std::int64_t last_time_ns_ = 0;  // of the last scan handed out
  bool reopened_ = false;          // since then
};

}  // namespace mdof::drivers::labjack_u6
