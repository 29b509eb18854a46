// Measurement Computing USB-1608FS-Plus over USB: up to eight amplifier outputs, all sampled at the
// same instant.
//
// The device neither stamps nor counts its scans: they are counted here, and DeviceClock brings
// scan k, taken at the start + k / rate by its clock, to the host's from the arrivals of transfers.
// That count is right only while no scan is missing. When the device's FIFO runs over it says so in
// its status alone, and not where. So scans are given out only after a status, asked for later than
// they came, says that there was no overrun; those behind it are thrown away and the stream is
// begun anew.
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
  double rate_hz_;                 // true
  std::vector<std::size_t> word_;  // of a scan, for each channel
  std::string description_;
  std::vector<Channel> channels_;
  std::optional<usb::Handle> handle_;
  std::optional<usb::InStream> stream_;
  Calibrations calibrations_;

  DeviceClock clock_;  // ticks are scans
  ScanSplitter line_;
  std::vector<std::uint16_t> words_;  // of scans received and not yet given out
  std::uint64_t first_ = 0;           // the scan that words_ begins with, since the start
  std::size_t sound_ = 0;             // scans of words_ before any overrun
  Time next_status_;
  std::int64_t last_chunk_ns_ = 0;  // host time; at first of the start

  std::int64_t last_time_ns_ = 0;  // of the last scan given out
  bool reopened_ = false;          // since then
};

}  // namespace mdof::drivers::mcc_usb1608fs_plus
