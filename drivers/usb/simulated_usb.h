// The host's view of a simulated USB device. Tests connect it to the bus of umockdev, mdof-simulate
// to that of the kernel (vhci_hcd), so libusb, hidapi and the kernel are real.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/simulated_device.h"

namespace mdof::drivers::usb {

enum class Speed { full, high };
inline constexpr std::size_t kFullSpeedPacket = 64;  // bytes, bulk

struct Identity {
  std::uint16_t vendor = 0, product = 0, version_bcd = 0x0100;
  Speed speed = Speed::full;
  std::string manufacturer, product_name, serial;  // ASCII; string descriptors 1, 2, 3
  // The configuration descriptor with its interface and endpoint descriptors, as on the wire.
  std::string configuration;
  // HID report descriptor of each interface; "" for an interface without HID. May be shorter.
  std::vector<std::string> hid_reports;
};

// Setup packet of a control transfer, USB 2.0 specification 9.3.
struct Setup {
  std::uint8_t request_type = 0, request = 0;
  std::uint16_t value = 0, index = 0, length = 0;
  bool in() const { return (request_type & 0x80) != 0; }
};

enum class Answer {
  done,     // bytes were accepted, or `bytes` is the data
  not_yet,  // NAK: the host asks again about every millisecond, until it cancels
  stall,    // control transfer: once; other endpoints: until clear_halt()
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
  // Class and vendor requests; standard_reply() answers standard requests.
  virtual Reply control(const Setup& setup, std::string_view out, std::int64_t now_ns) = 0;
  // One bulk or interrupt transfer from the device (bit 7 of the endpoint is set) or to it. Returns
  // at most `max_bytes`; a packet that is not full ends a transfer, as on the bus.
  virtual Reply in(std::uint8_t endpoint, std::size_t max_bytes, std::int64_t now_ns) = 0;
  virtual Reply out(std::uint8_t endpoint, std::string_view bytes, std::int64_t now_ns) = 0;
  virtual void clear_halt(std::uint8_t endpoint) = 0;
  // Whether the device was unplugged.
  virtual bool gone() const = 0;
};

// Reply to a standard request (USB 2.0 specification 9.4, HID 1.11 section 7.1.1); nullopt: the
// device must answer. Clears halts of `device` if requested.
std::optional<Reply> standard_reply(SimulatedUsb& device, const Setup& setup);
// The device descriptor.
std::string device_descriptor(const Identity& identity);

}  // namespace mdof::drivers::usb
