// Amplifier outputs at a board that Linux Comedi drives, by comedilib: up to all its analogue
// inputs in one hardware-timed scan.
//
// Comedi neither stamps nor counts scans: they are counted here from the start of the command, and
// DeviceClock brings scan k, taken at the start + k / rate by the board's clock, to the host's from
// the arrivals. When a buffer runs over the kernel ends the command, and what came before it is
// whole; the error begins a new one.
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
  double rate_hz_;     // true
  DeviceClock clock_;  // ticks are scans
  CodeSplitter line_;
  std::vector<char> buffer_;
  std::vector<std::uint32_t> codes_;  // of scans received and not yet given out
  std::uint64_t first_ = 0;           // the scan that codes_ begins with, since the start
  std::int64_t received_ns_ = 0;      // the newest; at first of the start
  Status broken_;                     // the error that ended the stream

  std::int64_t last_time_ns_ = 0;  // of the last scan given out
  bool reopened_ = false;          // since then
};

}  // namespace mdof::drivers::linux_comedi
