// Puts simulated USB devices on this machine's own bus, so that kernel, libusb and hidapi find them
// as they would find the real ones.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "drivers/usb/simulated_usb.h"
#include "schema/base/result.h"

namespace mdof::simulate {

// Thread-bound. Unplugs the device when it goes.
class UsbPort {
 public:
  virtual ~UsbPort() = default;
  virtual int fd() const = 0;  // to be polled for input
  // To be called when something came, and every millisecond or so besides. False: unplugged.
  virtual bool turn(std::int64_t now_ns) = 0;
  virtual std::string place() const = 0;  // "usb port 0", "uhid"
};

// Through the kernel's vhci_hcd: the whole USB. Error: the module is not loaded, no free port, no
// permission. The device is to live longer.
Result<std::unique_ptr<UsbPort>> plug_into_vhci(drivers::usb::SimulatedUsb& device);
// Its first HID interface that takes reports, through the kernel's uhid: no USB around it.
Result<std::unique_ptr<UsbPort>> plug_into_uhid(drivers::usb::SimulatedUsb& device);

}  // namespace mdof::simulate
