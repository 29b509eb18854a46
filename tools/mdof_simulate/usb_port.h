// Connects simulated USB devices to this computer. The kernel, libusb and hidapi then find them in
// the same way as real devices.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "drivers/usb/simulated_usb.h"
#include "schema/base/result.h"

namespace mdof::simulate {

// Thread-bound. The destructor unplugs the device.
class UsbPort {
 public:
  virtual ~UsbPort() = default;
  virtual int fd() const = 0;  // Wait for input on this descriptor.
  // Call it when input is available, and also about every millisecond. False: the device is
  // unplugged.
  virtual bool turn(std::int64_t now_ns) = 0;
  virtual std::string place() const = 0;  // "usb port 0", "uhid"
};

// Connects the device with the kernel module vhci_hcd, which simulates a complete USB port.
// `device` must exist longer than the port. Errors: the module is not loaded; no port is free; this
// user has no permission.
Result<std::unique_ptr<UsbPort>> plug_into_vhci(drivers::usb::SimulatedUsb& device);
// Connects the device with the kernel module uhid, without USB. Only its first HID interface that
// accepts reports is available.
Result<std::unique_ptr<UsbPort>> plug_into_uhid(drivers::usb::SimulatedUsb& device);

}  // namespace mdof::simulate
