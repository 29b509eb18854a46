// Driver of devices that are read periodically through sysfs files. Linux counters and Linux IIO
// converters use it.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "drivers/driver.h"
#include "drivers/sysfs/attribute.h"

namespace mdof::drivers {

// A reading of a channel, in the unit of the channel.
struct SysfsReading {
  double value = 0;
  Quality quality = Quality::good;
  bool passed_mark = false;  // true: from the next reading on, positions are counted from the mark
};
struct SysfsInput {
  Channel channel;
  std::function<Result<SysfsReading>()> read;
};
struct SysfsDevice {
  std::string description;
  // For an incremental encoder: reason why the datum is lost after the device was opened again; the
  // positions are then suspect. "": the encoder has no datum that can be lost.
  std::string datum_lost = {};
  Remedy datum_remedy = Remedy::set_encoder;
  std::vector<SysfsInput> inputs;
};

// Thread-bound. The inputs of a scan are read in their order. The time of the scan is the middle of
// the reading of the last input; the readings before it have a delay (drivers/README.md). A poll
// that fails, or is late by a period or more, counts as a lost scan. The scan after a failed poll
// is suspect. Five failed polls in succession are an error.
class SysfsPoller final : public Driver {
 public:
  static constexpr int kFailuresAllowed = 4;  // largest permitted number of successive failed polls

  // `open`: finds and checks the device; each open() calls it. `slow_ns`: a scan that needs more
  // time is suspect, because its time is uncertain; 0: no limit.
  SysfsPoller(std::string name, std::string driver, double rate_hz, std::int64_t slow_ns,
              std::function<Result<SysfsDevice>()> open);

  DeviceInfo info() const override;
  Status open() override;
  // Returns the scans of 10 ms, but at least one scan. Exceeds `timeout` by the duration of one
  // scan at most.
  Result<ReadState> read(SampleBlock& block, std::chrono::milliseconds timeout) override;
  void trust_count() override { datum_lost_ = false; }
  int marks_passed() const override { return marks_passed_; }

 private:
  Status poll(SampleBlock& block);
  Status count_failure(const Error& why);
  void schedule_next(std::int64_t now_ns);

  std::string name_, driver_;
  double rate_hz_;
  std::int64_t period_ns_, slow_ns_;
  std::function<Result<SysfsDevice>()> open_;
  SysfsDevice device_;
  std::vector<Channel> channels_;
  bool is_open_ = false, opened_before_ = false, datum_lost_ = false;
  std::int64_t next_ns_ = 0;
  std::uint64_t lost_ = 0;
  int failures_ = 0;  // number of failed polls in succession
  int marks_passed_ = 0;
  bool passed_mark_ = false;  // true: marks_passed_ increases with the next block
  std::int64_t last_time_ns_ = 0;
};

}  // namespace mdof::drivers
