// HID devices through hidapi with its hidraw back end. Only hid.cpp calls hidapi. libudev finds the
// devices (hid_list.cpp states why).
//
// hidapi has global state (its last error) and is not thread-safe. Therefore a global mutex
// serialises opening and closing. The library is never shut down, because another driver may use
// it. After a device is open, one thread uses the device without this mutex.
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
  std::string serial;  // serial number string of the device; "": the device has none
  int interface = -1;  // -1: the bus has no interfaces (uhid)
};

// Returns each connected HID interface of this vendor. Any thread may call it.
std::vector<HidEntry> list_hid(std::uint16_t vendor);

// Thread-bound.
class HidDevice {
 public:
  // Errors name the path and the remedy. One error is that another program uses the device
  // (device_lock.h).
  static Result<HidDevice> open(const std::string& path);
  // Sends an output report without report number. Error: the device is disconnected.
  Status write(std::string_view report);
  // Returns the next input report, at most `most` bytes; "": no report arrived before the time-out.
  // Error: the device is disconnected.
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
