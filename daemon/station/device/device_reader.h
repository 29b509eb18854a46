// A device as seen by the station of an axis: its own device (acquisition.h), or its part of a
// device that several axes share (shared_device.h).
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
  std::string error;             // text of the present failure; "": no failure
  std::string last_error;        // text of the last failure that is over; it ended at recovered_utc
  std::string recovered_utc;
  std::vector<Trouble> standing;  // present troubles
  drivers::DeviceInfo info;
  double measured_hz = 0;      // scans per second since opening; 0: unknown
  std::uint64_t scans = 0;     // number of scans since the start
  std::uint64_t lost = 0;      // scans known to be lost
  std::uint64_t dropped = 0;   // blocks for which the queue of the measure thread had no space
  std::uint64_t reopened = 0;  // number of reopenings
};

// Receiver of the samples; all calls are on the acquisition thread. `pass` counts the readings of a
// source that is read once per run.
struct DeviceSink {
  // True: the block was taken, and `block` is now another, used block whose memory can be reused.
  // False: there was no space within `wait`; the block did not change.
  std::function<bool(SampleBlock& block, std::uint64_t pass, std::chrono::milliseconds wait)>
      samples;
  // The source has ended or, with a reason, cannot recover.
  std::function<void(std::uint64_t pass, const std::string& reason, const drivers::SourceInfo&)>
      ended;
  std::function<void(const Trouble&)> trouble;  // may be empty
  // From the next block on, the encoder of this device is counted from its reference mark. May be
  // empty.
  std::function<void(const std::string& device)> mark = {};
};

// Call it from the station's threads, one call at a time. status(), healthy(), request_stop(),
// wake() and trust_count() are thread-safe.
class DeviceReader {
 public:
  virtual ~DeviceReader() = default;  // stops the device
  virtual void start() = 0;
  virtual void stop() = 0;          // no call of the sink follows
  virtual void request_stop() = 0;  // stops soon, without waiting
  // A user has set the position of the axis, so that the datum is no longer lost.
  virtual void trust_count() = 0;
  virtual void wake() = 0;  // a device was plugged in: ends the present waiting time
  virtual std::uint64_t pass() const = 0;
  virtual const drivers::DriverSpec& spec() const = 0;
  virtual DeviceStatus status() const = 0;
  // Whether the thread has reported within `limit` or has nothing to do.
  virtual bool healthy(std::chrono::steady_clock::duration limit) const = 0;
};

}  // namespace mdof::daemon
