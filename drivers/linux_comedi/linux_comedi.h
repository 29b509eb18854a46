// Driver for a board with a Linux Comedi driver, through comedilib. One hardware-timed scan
// contains the outputs of the amplifiers at the analogue inputs.
//
// Comedi neither numbers the scans nor sends time stamps. The driver counts the scans from the
// start of the command: scan k was taken at the time start + k / rate of the board's clock.
// DeviceClock converts this time to the host's clock from the times at which data arrive. If a
// buffer overflows, the kernel ends the command; all data before the overflow are valid. read()
// then returns an error, after which the caller calls open() again, and open() starts a new
// command.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "drivers/clock/device_clock.h"
#include "drivers/driver.h"
#include "drivers/linux_comedi/setup.h"
#include "drivers/loss_while_closed.h"

namespace mdof::drivers::linux_comedi {

// Thread-bound. Unit of the channels: Unit::volt.
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
  std::string place() const;

  Settings settings_;
  std::vector<Channel> channels_;
  std::unique_ptr<Board> board_;
  Setup setup_;
  double rate_hz_;     // actual rate
  DeviceClock clock_;  // a tick is a scan
  CodeSplitter line_;
  std::vector<char> buffer_;
  std::vector<std::uint32_t> codes_;  // codes of scans that were received and not returned yet
  std::uint64_t first_ = 0;           // number of the first scan in codes_, counted from the start
  // Newest time of arrival; before the first arrival, the time of the start.
  std::int64_t received_ns_ = 0;
  Status broken_;  // the error that ended the stream

  LossWhileClosed loss_;
};

}  // namespace mdof::drivers::linux_comedi
