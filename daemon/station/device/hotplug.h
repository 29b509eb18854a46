// Reports plugged-in devices, so that a device can be opened without further waiting.
#pragma once

#include <memory>

#include "schema/base/result.h"

struct udev;
struct udev_monitor;

namespace mdof::daemon {

// Events of udev after its rules, so that the permissions are set. Thread-bound.
class Hotplug {
 public:
  // Watches USB, hidraw, serial ports, counters and IIO. Error: the kernel rejects a monitor.
  // Without udevd, as in most containers, there are no events.
  static Result<Hotplug> watch();

  int descriptor() const;  // readable if there are events
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
