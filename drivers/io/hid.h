// HID devices through hidapi's hidraw back end: the only place that calls it. They are found by
// libudev (hid_list.cpp says why).
//
// hidapi keeps global state (its last error) and is not thread-safe: devices are opened and closed
// one at a time in the process, and the library is never shut down, as another driver may be using
// it. An open device is used by one thread without that lock.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/io/device_lock.h"
#include "schema/base/result.h"

namespace mdof::drivers {

struct HidEntry {
  std::string path;  // "/dev/hidraw3"
  std::uint16_t product = 0;
  std::string serial;  // as the device's string has it; "" where it has none
  int interface = -1;  // -1: the bus has none (uhid)
};

// Every HID interface of this vendor that is plugged in. By any thread.
std::vector<HidEntry> list_hid(std::uint16_t vendor);

// Thread-bound.
class HidDevice {
 public:
  // Errors name the path and the remedy; also where another program has it (device_lock.h).
  static Result<HidDevice> open(const std::string& path);
  // Output report without a number. Error: the device is gone.
  Status write(std::string_view report);
  // The next input report, at most `most` bytes; "": none within the time-out. Error: gone.
  Result<std::string> read(std::size_t most, std::chrono::milliseconds timeout);
  const std::string& path() const { return path_; }

 private:
  struct Close {
    void operator()(void* device) const;
  };
  HidDevice(DeviceLock lock, void* device, std::string path)
      : lock_(std::move(lock)), device_(device), path_(std::move(path)) {}
  DeviceLock lock_;  // goes after the device
  std::unique_ptr<void, Close> device_;
  std::string path_;
};

}  // namespace mdof::drivers
