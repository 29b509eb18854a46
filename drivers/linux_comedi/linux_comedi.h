// Amplifier outputs at a board with a Linux Comedi driver, through comedilib: up to all its
// analogue inputs in one hardware-timed scan.
//
// Comedi neither stamps nor counts scans. The driver counts them from the start of the command:
// scan k was taken at the start + k / rate of the board's clock. DeviceClock converts this time to
// the host's clock from the arrivals. If a buffer overruns, the kernel ends the command; all
// earlier data are valid. The error makes the caller open the driver again, which starts a new
// command.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "drivers/clock/device_clock.h"
#include "drivers/driver.h"
#include "drivers/linux_comedi/setup.h"

namespace mdof::drivers::linux_comedi {

// Thread-bound. Channels: Unit::volt.
class LinuxComedi final : public Driver {
 public:
  explicit LinuxComedi(Settings settings);
  ~LinuxComedi() override;  // ends the command

  DeviceInfo info() const override;
  const DeviceClock* clock() const override { return &clock_; }
  Status open() override;
  Result<ReadState> read(SampleBlock& block, std::chrono::milliseconds timeout) override;

 private:
  using Time = std::chrono::steady_clock::time_point;
  void close();
  Status start();
  Status receive(Time until);
  void take(std::size_t bytes);
  Status check(StreamState stream);
  void fill_block(SampleBlock& block);
  void append(SampleBlock& block, std::size_t scan);
  std::uint64_t lost_while_closed(std::int64_t time_ns) const;
  std::string place() const;

  Settings settings_;
  std::vector<Channel> channels_;
  std::unique_ptr<Board> board_;
  Setup setup_;
  double rate_hz_;     // true rate
  DeviceClock clock_;  // a tick is a scan
  CodeSplitter line_;
  std::vector<char> buffer_;
  std::vector<std::uint32_t> codes_;  // of scans received but not yet returned
  std::uint64_t first_ = 0;           // number of the first scan in codes_ since the start
  std::int64_t received_ns_ = 0;      // newest arrival; initially the time of the start
  Status broken_;                     // the error that ended the stream

  std::int64_t last_time_ns_ = 0;  // of the last returned scan
  bool reopened_ = false;          // since the last returned scan
};

}  // namespace mdof::drivers::linux_comedi
