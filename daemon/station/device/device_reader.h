// A device as the station of an axis has it: its own (acquisition.h), or its part of one that
// several axes have (shared_device.h).
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
  std::string error;             // of the failure that holds; "": it is well
  std::string last_error;        // of the last one that is over, and when that was
  std::string recovered_utc;
  std::vector<Trouble> standing;  // what holds now
  drivers::DeviceInfo info;
  double measured_hz = 0;      // scans a second since it was opened; 0: not known yet
  std::uint64_t scans = 0;     // since the start
  std::uint64_t lost = 0;      // scans that are known to have been lost
  std::uint64_t dropped = 0;   // blocks the measuring thread had no room for
  std::uint64_t reopened = 0;  // times
};

// Where what is read goes: all on the acquiring thread. `pass` counts the readings of a source that
// is read once a run.
struct DeviceSink {
  // True: taken over; `block` is then another one, used up, whose memory the next may reuse. False:
  // there was no room within `wait`, the block is untouched.
  std::function<bool(SampleBlock& block, std::uint64_t pass, std::chrono::milliseconds wait)>
      samples;
  // The source has ended, or, with a reason, will not recover.
  std::function<void(std::uint64_t pass, const std::string& reason, const drivers::SourceInfo&)>
      ended;
  std::function<void(const Trouble&)> trouble;  // may be none
  // The encoder of this device is counted from its reference mark from the next block on. May be
  // none.
  std::function<void(const std::string& device)> mark = {};
};

// Calls from the station's threads, one at a time, but for status(), healthy(), cease(), wake()
// and trust_count().
class DeviceReader {
 public:
  virtual ~DeviceReader() = default;  // stops
  virtual void start() = 0;
  virtual void stop() = 0;   // nothing comes any more
  virtual void cease() = 0;  // soon, without waiting for it
  // Somebody has said where the axis stands: the datum is no longer lost.
  virtual void trust_count() = 0;
  virtual void wake() = 0;  // a device was plugged in: the pause under way ends
  virtual std::uint64_t pass() const = 0;
  virtual const drivers::DriverSpec& spec() const = 0;
  virtual DeviceStatus status() const = 0;
  // Came round within `limit`, or has nothing to do.
  virtual bool healthy(std::chrono::steady_clock::duration limit) const = 0;
};

}  // namespace mdof::daemon
