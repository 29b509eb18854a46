// Driver of a Measurement Computing USB-1608FS-Plus over USB: the outputs of up to eight
// amplifiers, all sampled at the same instant.
//
// The device neither numbers its scans nor sends time stamps. The driver counts the scans: scan k
// was taken at the time start + k / rate of the device's clock. DeviceClock converts this time to
// the host's clock from the times at which transfers arrive. The count is correct only while no
// scan is missing. If the FIFO of the device overflows, only the status of the device reports this,
// without the position of the missing scans. Therefore the driver requests a status after the
// arrival of scans, and returns these scans only if the status reports no overrun. After an overrun
// the driver discards the remaining scans and starts the stream again.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "drivers/clock/device_clock.h"
#include "drivers/driver.h"
#include "drivers/loss_while_closed.h"
#include "drivers/mcc_usb1608fs_plus/settings.h"

namespace mdof::drivers::mcc_usb1608fs_plus {

// Thread-bound. Unit of the channels: Unit::volt.
class MccUsb1608fsPlus final : public Driver {
 public:
  explicit MccUsb1608fsPlus(Settings settings);
  ~MccUsb1608fsPlus() override;  // stops the scan

  DeviceInfo info() const override;
  const DeviceClock* clock() const override { return &clock_; }
  Status open() override;
  Result<ReadState> read(SampleBlock& block, std::chrono::milliseconds timeout) override;

 private:
  using Time = std::chrono::steady_clock::time_point;
  void close();
  Status start();
  Status stop_scan();
  Status read_calibrations();
  Status receive(Time until);
  Status take_chunk(Time until);
  Status check_status();
  void fill_block(SampleBlock& block);
  std::string place() const;

  Settings settings_;
  ScanSetup setup_;
  double rate_hz_;                 // actual rate
  std::vector<std::size_t> word_;  // position of each channel in a scan
  std::string description_;
  std::vector<Channel> channels_;
  std::optional<usb::Handle> handle_;
  std::optional<usb::InStream> stream_;
  Calibrations calibrations_;

  DeviceClock clock_;  // a tick is a scan
  ScanSplitter line_;
  std::vector<std::uint16_t> words_;  // words of scans that were received and not returned yet
  std::uint64_t first_ = 0;           // number of the first scan in words_, counted from the start
  // number of scans in words_ that arrived before a status without overrun
  std::size_t confirmed_ = 0;
  Time next_status_;
  // Host time at which the last transfer arrived; before the first transfer, the time of the start.
  std::int64_t last_chunk_ns_ = 0;

  LossWhileClosed loss_;
};

}  // namespace mdof::drivers::mcc_usb1608fs_plus
