// The driver of devices that are asked, at an even rate, through files of sysfs: what Linux
// counters and Linux IIO converters have in common.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "drivers/driver.h"
#include "drivers/sysfs/attribute.h"

namespace mdof::drivers {

// One channel as opened: asks the device for its raw value, in the channel's unit.
struct SysfsReading {
  double value = 0;
  Quality quality = Quality::good;
  bool passed_mark = false;  // of an encoder: from the next reading on it is counted from its mark
};
struct SysfsInput {
  Channel channel;
  std::function<Result<SysfsReading>()> read;
};
struct SysfsDevice {
  std::string description;
  // Of an incremental encoder: what is to be said of its datum once it was opened again, from when
  // on its values are suspect. "": it has none to lose.
  std::string datum_lost = {};
  Remedy datum_remedy = Remedy::set_encoder;
  std::vector<SysfsInput> inputs;
};

// Thread-bound. The time of a scan is the middle between before its first and after its last
// reading. Polls that were not made in time, or failed, are lost; the scan after a failed one is
// suspect; five failed ones in a row are an error.
class SysfsPoller final : public Driver {
 public:
  static constexpr int kFailuresAllowed = 4;  // in a row

  // `open` finds and checks the device; called at each open(). `slow_ns`: a scan that takes longer
  // is suspect, as nobody knows when in that time it was taken; 0: the device takes its time.
  SysfsPoller(std::string name, std::string driver, double rate_hz, std::int64_t slow_ns,
              std::function<Result<SysfsDevice>()> open);

  DeviceInfo info() const override;
  Status open() override;
  // Gives what 10 ms bring, at least one scan; takes longer than `timeout` only by one scan.
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
  bool passed_mark_ = false;  // with the next block
  std::int64_t last_time_ns_ = 0;
};

}  // namespace mdof::drivers
