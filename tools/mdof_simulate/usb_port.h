// Connects simulated USB devices to the bus of this computer, so that kernel, libusb and hidapi
// find them like real devices.
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
  virtual int fd() const = 0;  // Poll it for input.
  // Call it when input is available, and also about every millisecond. False: unplugged.
  virtual bool turn(std::int64_t now_ns) = 0;
  virtual std::string place() const = 0;  // "usb port 0", "uhid"
};

// Uses the kernel's vhci_hcd, which simulates the complete USB. Errors: the module is not loaded,
// no port is free, no permission. `device` must outlive the port.
Result<std::unique_ptr<UsbPort>> plug_into_vhci(drivers::usb::SimulatedUsb& device);
// Connects only the first HID interface that accepts reports through the kernel's uhid, without
// USB.
Result<std::unique_ptr<UsbPort>> plug_into_uhid(drivers::usb::SimulatedUsb& device);

}  // namespace mdof::simulate
