// Reports when a device was plugged in, so that whoever waits to open one need not wait longer.
#pragma once

#include <memory>

#include "schema/base/result.h"

struct udev;
struct udev_monitor;

namespace mdof::daemon {

// Events of udev, after its rules: the permissions are set. Thread-bound.
class Hotplug {
 public:
  // Of USB, hidraw, serial ports, counters and IIO. Error: the kernel refuses a monitor. Where no
  // udevd runs, as in most containers, no event ever comes.
  static Result<Hotplug> watch();

  int descriptor() const;  // readable when something happened
  // Takes all events that wait; whether a device came.
  bool take_arrivals();

 private:
  struct Free {
    void operator()(udev* context) const;
    void operator()(udev_monitor* monitor) const;
  };
  std::unique_ptr<udev, Free> udev_;
  std::unique_ptr<udev_monitor, Free> monitor_;
};

}  // namespace mdof::daemon
