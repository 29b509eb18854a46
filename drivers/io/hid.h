// HID devices through hidapi with the hidraw back end. Only this file calls hidapi. libudev finds
// the devices (hid_list.cpp gives the reason).
//
// hidapi has global state (its last error) and is not thread-safe. Therefore a mutex of the process
// serialises opening and closing, and the library is never shut down, because another driver may
// use it. An open device is used by one thread without this mutex.
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
  std::string serial;  // string of the device; "": it has none
  int interface = -1;  // -1: the bus has no interfaces (uhid)
};

// Every connected HID interface of this vendor. Any thread may call it.
std::vector<HidEntry> list_hid(std::uint16_t vendor);

// Thread-bound.
class HidDevice {
 public:
  // Errors name the path and the remedy, also if another program uses the device (device_lock.h).
  static Result<HidDevice> open(const std::string& path);
  // Sends an output report without report number. Error: the device is gone.
  Status write(std::string_view report);
  // The next input report, at most `most` bytes; "": none before the time-out. Error: the device is
  // gone.
  Result<std::string> read(std::size_t most, std::chrono::milliseconds timeout);
  const std::string& path() const { return path_; }

 private:
  struct Close {
    void operator()(void* device) const;
  };
  HidDevice(DeviceLock lock, void* device, std::string path)
      : lock_(std::move(lock)), device_(device), path_(std::move(path)) {}
  DeviceLock lock_;  // released after the device is closed
  std::unique_ptr<void, Close> device_;
  std::string path_;
};

}  // namespace mdof::drivers
