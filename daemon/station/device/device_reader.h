// Interface between the station of an axis and a device. The device belongs to this axis alone
// (acquisition.h), or several axes share it (shared_device.h).
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "daemon/station/device/trouble.h"
#include "drivers/driver_spec.h"
#include "schema/sample.h"

namespace mdof::daemon {

struct DeviceStatus {
  std::string state = "closed";  // "open", "closed", "failed: reopening", "ended"
  std::string error;             // text of the current error; "": no error
  // Text of the last error from which the device has recovered, at recovered_utc.
  std::string last_error;
  std::string recovered_utc;
  std::vector<Trouble> standing;  // current troubles
  drivers::DeviceInfo info;
  double measured_hz = 0;   // scans per second since the device was opened; 0: unknown
  std::uint64_t scans = 0;  // number of scans since start()
  std::uint64_t lost = 0;   // number of scans that are known to be lost
  // Number of blocks for which the queue of the measure thread had no space.
  std::uint64_t dropped = 0;
  std::uint64_t reopened = 0;  // how often the device was opened again
};

// Receives the samples. All functions are called on the acquisition thread. `pass`: number of the
// pass through the log, because a replay reads the log once for each run.
struct DeviceSink {
  // True: the receiver has taken the block. `block` is then an older block, so that its memory can
  // be used again. False: the queue had no space within the time `wait`; `block` did not change.
  std::function<bool(SampleBlock& block, std::uint64_t pass, std::chrono::milliseconds wait)>
      samples;
  // The source has ended. If `reason` is not empty, the source has an error and cannot recover.
  std::function<void(std::uint64_t pass, const std::string& reason, const drivers::SourceInfo&)>
      ended;
  std::function<void(const Trouble&)> trouble;  // may be empty
  // The encoder of this device has passed its reference mark. From the next block, the positions of
  // the encoder are counted from the mark. The function may be empty.
  std::function<void(const std::string& device)> mark = {};
};

// The threads of the station call these functions, one call at a time. status(), healthy(),
// request_stop(), wake() and trust_count() are thread-safe.
class DeviceReader {
 public:
  virtual ~DeviceReader() = default;  // calls stop()
  virtual void start() = 0;
  virtual void stop() = 0;          // afterwards no function of the sink is called
  virtual void request_stop() = 0;  // asks the thread to stop, and does not wait for the thread
  // A user has set the position of the axis, so the datum of the encoder is valid again.
  virtual void trust_count() = 0;
  virtual void wake() = 0;  // a device was plugged in: open the device now, without further waiting
  virtual std::uint64_t pass() const = 0;
  virtual const drivers::DriverSpec& spec() const = 0;
  virtual DeviceStatus status() const = 0;
  // Whether the thread has reported within `limit` or has nothing to do.
  virtual bool healthy(std::chrono::steady_clock::duration limit) const = 0;
};

}  // namespace mdof::daemon
