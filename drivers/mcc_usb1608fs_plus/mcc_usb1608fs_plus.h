// Measurement Computing USB-1608FS-Plus over USB: up to eight amplifier outputs, sampled at the
// same instant.
//
// The device neither stamps nor counts its scans. The driver counts them: scan k was taken at the
// start + k / rate of the device's clock. DeviceClock converts this time to the host's clock from
// the arrivals of transfers. The count is right only while no scan is missing. If the FIFO of the
// device overruns, only its status reports this, without the position. Therefore scans are returned
// only after a status that was requested after their arrival reports no overrun. After an overrun
// the remaining scans are discarded and the stream is started again.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "drivers/clock/device_clock.h"
#include "drivers/driver.h"
#include "drivers/mcc_usb1608fs_plus/settings.h"

namespace mdof::drivers::mcc_usb1608fs_plus {

// Thread-bound. Channels: Unit::volt.
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
  std::uint64_t lost_while_closed(std::int64_t time_ns) const;
  std::string place() const;

  Settings settings_;
  ScanSetup setup_;
  double rate_hz_;                 // true rate
  std::vector<std::size_t> word_;  // index in a scan, for each channel
  std::string description_;
  std::vector<Channel> channels_;
  std::optional<usb::Handle> handle_;
  std::optional<usb::InStream> stream_;
  Calibrations calibrations_;

  DeviceClock clock_;  // a tick is a scan
  ScanSplitter line_;
  std::vector<std::uint16_t> words_;  // of scans received but not yet returned
  std::uint64_t first_ = 0;           // number of the first scan in words_ since the start
  std::size_t confirmed_ = 0;         // number of scans in words_ that a status has confirmed
  Time next_status_;
  std::int64_t last_chunk_ns_ = 0;  // host time; initially the time of the start

  std::int64_t last_time_ns_ = 0;  // of the last returned scan
  bool reopened_ = false;          // since the last returned scan
};

}  // namespace mdof::drivers::mcc_usb1608fs_plus
