// Driver of devices that are polled at an even rate through sysfs files: the common part of Linux
// counters and Linux IIO converters.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "drivers/driver.h"
#include "drivers/sysfs/attribute.h"

namespace mdof::drivers {

// A channel of an open device. `read` requests the raw value, in the unit of the channel.
struct SysfsReading {
  double value = 0;
  Quality quality = Quality::good;
  bool passed_mark = false;  // from the next reading on, positions are counted from the mark
};
struct SysfsInput {
  Channel channel;
  std::function<Result<SysfsReading>()> read;
};
struct SysfsDevice {
  std::string description;
  // Of an incremental encoder: why its datum is lost after the device was opened again; its values
  // are then suspect. "": no datum to lose.
  std::string datum_lost = {};
  Remedy datum_remedy = Remedy::set_encoder;
  std::vector<SysfsInput> inputs;
};

// Thread-bound. The time of a scan is the middle between the beginning of its first reading and the
// end of its last. Polls that failed or were not made in time are lost; the scan after a failed
// poll is suspect; five failed polls in a row are an error.
class SysfsPoller final : public Driver {
 public:
  static constexpr int kFailuresAllowed = 4;  // in a row

  // `open` finds and checks the device; each open() calls it. `slow_ns`: a scan that takes longer
  // is suspect, because its time is uncertain; 0: no limit.
  SysfsPoller(std::string name, std::string driver, double rate_hz, std::int64_t slow_ns,
              std::function<Result<SysfsDevice>()> open);

  DeviceInfo info() const override;
  Status open() override;
  // Returns the scans of 10 ms, at least one. Exceeds `timeout` by at most one scan.
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
  int failures_ = 0;  // in a row
  int marks_passed_ = 0;
  bool passed_mark_ = false;  // counted in marks_passed_ with the next block
  std::int64_t last_time_ns_ = 0;
};

}  // namespace mdof::drivers
