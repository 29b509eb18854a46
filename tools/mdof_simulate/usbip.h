// The protocol USB/IP (Linux, Documentation/usb/usbip_protocol.rst), with which the kernel module
// vhci_hcd sends USB requests to a simulated device. This class converts bytes and does no input or
// output.
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <string_view>

#include "drivers/usb/simulated_usb.h"

namespace mdof::simulate {

class UsbIp {
 public:
  // `device` must outlive this object.
  explicit UsbIp(drivers::usb::SimulatedUsb& device) : device_(&device) {}

  // Handles the bytes `received` from the host (may be empty) and returns the bytes to send. Call
  // it when bytes arrive, and also about every millisecond, because a transfer waits until the
  // device has data.
  std::string exchange(std::string_view received, std::int64_t now_ns);
  // True: the host sent bytes that are not USB/IP, or requested an isochronous transfer. The
  // connection cannot be used further.
  bool broken() const { return broken_; }

 private:
  struct Transfer {
    std::uint32_t number = 0;
    bool in = false;
    std::uint8_t endpoint = 0;  // Without the direction.
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
  std::deque<Transfer> waiting_;  // In order of arrival.
  bool broken_ = false;
};

}  // namespace mdof::simulate
