// LabJack U6 over USB. One hardware-timed scan contains the outputs of the amplifiers and one
// quadrature encoder.
//
// The device sends no time stamps. Scan k was taken at the time start + k / rate of the device's
// clock; k also counts the dropped scans that the device reports. DeviceClock converts this time to
// the host's clock from the times at which transfers arrive. In a scan, two successive inputs are
// sampled about 10 us apart; the whole scan has one time.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "drivers/clock/device_clock.h"
#include "drivers/driver.h"
#include "drivers/labjack/counter.h"
#include "drivers/labjack/received_scans.h"
#include "drivers/labjack_u6/settings.h"
#include "drivers/loss_while_closed.h"

namespace mdof::drivers::labjack_u6 {

// Thread-bound. Unit of the channels: Unit::volt for an AIN, Unit::um for the counter.
//
// The counter starts from 0 when this object opens the device for the first time. It continues when
// the device is opened again. The zero is lost if the counter has stopped (the U6 was unplugged) or
// if the counting rate was above the limit. The values of the counter are then Quality::suspect
// until trust_count() is called.
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
  Status receive(std::chrono::milliseconds timeout);
  Status silence_error();
  Status take(const usb::InStream::Chunk& chunk);
  void append(SampleBlock& block, const Scan& scan);
  std::string place() const;

  Settings settings_;
  std::vector<Entry> list_;
  StreamClock scan_clock_;
  std::size_t samples_;  // number of samples in a packet
  std::string description_;
  std::vector<Channel> channels_;
  std::optional<usb::Handle> handle_;
  std::optional<usb::InStream> stream_;
  ScanNumbering line_;
  std::array<AinCalibration, 4> calibrations_;  // for the gains 0 ... 3

  DeviceClock clock_;  // a tick is a scan
  // Host time at which the last transfer arrived; before the first transfer, the time of the start.
  std::int64_t last_chunk_ns_ = 0;
  labjack::ReceivedScans received_;

  labjack::Counter counter_;
  LossWhileClosed loss_;
};

}  // namespace mdof::drivers::labjack_u6
