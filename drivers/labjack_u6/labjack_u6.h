// LabJack U6 over USB: amplifier outputs and one quadrature encoder in one hardware-timed scan.
//
// The device sends no time stamps: scan k was taken at the start + k / rate of the device's clock,
// where k includes the dropped scans that the device reports. DeviceClock converts this time to the
// host's clock from the arrivals of transfers. Within a scan the inputs follow each other by about
// 10 us; the scan has one time.
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
// The counter is started from 0 when this object opens the device for the first time, and keeps
// running when the device is opened again. If the counter had stopped (the U6 was unplugged) or the
// count was faster than the limit, its zero is lost: its values are Quality::suspect until
// trust_count().
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
  Status start_or_keep_counter();
  Status next_scans(std::chrono::milliseconds timeout);
  Status receive(std::chrono::milliseconds timeout);
  Status silence_error();
  Status take(const usb::InStream::Chunk& chunk);
  void fill_block(SampleBlock& block);
  void append(SampleBlock& block, const Scan& scan);
  std::uint64_t lost_while_closed(std::int64_t time_ns) const;
  std::string place() const;

  Settings settings_;
  std::vector<Entry> list_;
  StreamClock scan_clock_;
  std::size_t samples_;  // in a packet
  std::string description_;
  std::vector<Channel> channels_;
  std::optional<usb::Handle> handle_;
  std::optional<usb::InStream> stream_;
  PacketLine line_;
  std::array<AinCalibration, 4> calibrations_;  // by gain

  DeviceClock clock_;               // a tick is a scan
  std::int64_t last_chunk_ns_ = 0;  // host time; initially the time of the start
  std::vector<Scan> scans_;         // received
  std::size_t returned_ = 0;        // number of scans_ already returned
  Status broken_;                   // the error that ended the stream

  Unwrap count_{32, true};
  bool counted_ = false;           // the counter was started by this object
  bool zero_lost_ = false;         // of the counter
  labjack::CountGuard guard_;      // of the counter
  std::int64_t last_time_ns_ = 0;  // of the last returned scan
  bool reopened_ = false;          // since the last returned scan
};

}  // namespace mdof::drivers::labjack_u6
