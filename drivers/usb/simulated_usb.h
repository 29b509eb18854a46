// Interface of a simulated USB device to the host. Tests connect the device to the simulated bus of
// umockdev; mdof-simulate connects it to a bus of the kernel (vhci_hcd). In both cases libusb and
// hidapi are the real libraries.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/simulated_device.h"

namespace mdof::drivers::usb {

enum class Speed { full, high };
inline constexpr std::size_t kFullSpeedPacket = 64;  // bytes in a bulk packet

struct Identity {
  std::uint16_t vendor = 0, product = 0, version_bcd = 0x0100;
  Speed speed = Speed::full;
  std::string manufacturer, product_name, serial;  // ASCII; string descriptors 1, 2, 3
  // The configuration descriptor with its interface and endpoint descriptors, as bytes on the bus.
  std::string configuration;
  // HID report descriptor of each interface; "": the interface has no HID. The list may be shorter
  // than the list of interfaces.
  std::vector<std::string> hid_reports;
};

// Setup packet of a control transfer, USB 2.0 specification 9.3.
struct Setup {
  std::uint8_t request_type = 0, request = 0;
  std::uint16_t value = 0, index = 0, length = 0;
  bool in() const { return (request_type & 0x80) != 0; }
};

enum class Answer {
  done,     // the bytes were accepted, or `bytes` contains the data
  not_yet,  // NAK: the host asks again about every millisecond until it cancels the transfer
  stall,    // control transfer: stalls once; other endpoints: until clear_halt()
};
struct Reply {
  Answer answer = Answer::done;
  std::string bytes;
};

// A simulated device with a USB connection.
class SimulatedUsb : public SimulatedDevice {
 public:
  SimulatedUsb* on_usb() final { return this; }
  virtual const Identity& identity() const = 0;
  // Answers class and vendor requests; standard_reply() answers standard requests.
  virtual Reply control(const Setup& setup, std::string_view out, std::int64_t now_ns) = 0;
  // One bulk or interrupt transfer: in() from the device (bit 7 of the endpoint is set), out() to
  // the device. in() returns at most `max_bytes`; a packet that is not full ends the transfer, as
  // on a real bus.
  virtual Reply in(std::uint8_t endpoint, std::size_t max_bytes, std::int64_t now_ns) = 0;
  virtual Reply out(std::uint8_t endpoint, std::string_view bytes, std::int64_t now_ns) = 0;
  virtual void clear_halt(std::uint8_t endpoint) = 0;
  // Whether the device was unplugged.
  virtual bool gone() const = 0;
};

// Reply to a standard request (USB 2.0 specification 9.4, HID 1.11 section 7.1.1); nullopt: the
// device itself must answer. A request to clear a halt clears the halt of `device`.
std::optional<Reply> standard_reply(SimulatedUsb& device, const Setup& setup);
// The device descriptor, as bytes on the bus.
std::string device_descriptor(const Identity& identity);

}  // namespace mdof::drivers::usb
