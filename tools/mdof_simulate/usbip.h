// USB/IP (Linux, Documentation/usb/usbip_protocol.rst): how the kernel's vhci_hcd asks a device
// that is not on any wire for what it would have been asked on one. Bytes in, bytes out: no I/O.
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <string_view>

#include "drivers/usb/simulated_usb.h"

namespace mdof::simulate {

class UsbIp {
 public:
  // The device is to live longer.
  explicit UsbIp(drivers::usb::SimulatedUsb& device) : device_(&device) {}

  // What the host is sent now, after `received` (maybe nothing) came from it. To be called whenever
  // something came, and every millisecond or so besides: transfers wait for the device.
  std::string exchange(std::string_view received, std::int64_t now_ns);
  // What came is not USB/IP, or asks for isochronous transfers: of no more use.
  bool broken() const { return broken_; }

 private:
  struct Transfer {
    std::uint32_t number = 0;
    bool in = false;
    std::uint8_t endpoint = 0;  // without direction
    std::uint32_t length = 0;
    drivers::usb::Setup setup;
    std::string out;
  };
  bool take_command(std::int64_t now_ns);
  bool take_submit();
  void take_unlink();
  void complete(const Transfer& transfer, int status, std::string_view bytes);
  drivers::usb::Reply reply_to(const Transfer& transfer, std::int64_t now_ns);
  void serve(std::int64_t now_ns);

  drivers::usb::SimulatedUsb* device_;
  std::string received_, to_send_;
  std::deque<Transfer> waiting_;  // in the order they came
  bool broken_ = false;
};

}  // namespace mdof::simulate
