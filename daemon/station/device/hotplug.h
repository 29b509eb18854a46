// Reports that a device was plugged in. A lost device is then opened without further waiting.
#pragma once

#include <memory>

#include "schema/base/result.h"

struct udev;
struct udev_monitor;

namespace mdof::daemon {

// Reads events of udev. udev sends them after it has applied its rules, so that the file
// permissions of the device are set. Thread-bound.
class Hotplug {
 public:
  // Watches the subsystems USB, hidraw, tty, counter and IIO. Error: udev cannot be used. If udevd
  // does not run, as in most containers, no event arrives.
  static Result<Hotplug> watch();

  int descriptor() const;  // the file descriptor is readable if events are pending
  // Reads all pending events; returns whether a device was plugged in.
  bool read_arrivals();

 private:
  struct Free {
    void operator()(udev* context) const;
    void operator()(udev_monitor* monitor) const;
  };
  std::unique_ptr<udev, Free> udev_;
  std::unique_ptr<udev_monitor, Free> monitor_;
};

}  // namespace mdof::daemon
