// A simulated USB device, as the host sees it. Tests put it on the bus of umockdev, mdof-simulate
// on that of the kernel (vhci_hcd): libusb, hidapi and the kernel are the real ones.
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
  // The configuration descriptor with those of its interfaces and endpoints, as on the wire.
  std::string configuration;
  // HID report descriptor of each interface; "" where it is none. May be shorter.
  std::vector<std::string> hid_reports;
};

// Setup packet of a control transfer, USB 2.0 specification 9.3.
struct Setup {
  std::uint8_t request_type = 0, request = 0;
  std::uint16_t value = 0, index = 0, length = 0;
  bool in() const { return (request_type & 0x80) != 0; }
};

enum class Answer {
  done,     // bytes were taken, or `bytes` are what comes
  not_yet,  // NAK: asked again about every millisecond, until the host cancels
  stall,    // of a control transfer this once; of another endpoint until clear_halt()
};
struct Reply {
  Answer answer = Answer::done;
  std::string bytes;
};

// A simulated device that is on the USB.
class SimulatedUsb : public SimulatedDevice {
 public:
  SimulatedUsb* on_usb() final { return this; }
  virtual const Identity& identity() const = 0;
  // Class and vendor requests; the standard ones are answered by standard_reply().
  virtual Reply control(const Setup& setup, std::string_view out, std::int64_t now_ns) = 0;
  // One bulk or interrupt transfer from (bit 7 of the endpoint set) or to the device. At most
  // `max_bytes` are given; a transfer ends with a packet that is not full, as on the bus.
  virtual Reply in(std::uint8_t endpoint, std::size_t max_bytes, std::int64_t now_ns) = 0;
  virtual Reply out(std::uint8_t endpoint, std::string_view bytes, std::int64_t now_ns) = 0;
  virtual void clear_halt(std::uint8_t endpoint) = 0;
  // The device has left the bus.
  virtual bool gone() const = 0;
};

// To a standard request (USB 2.0 specification 9.4, HID 1.11 section 7.1.1); none: the device's own
// to answer. Clears halts of `device` where asked to.
std::optional<Reply> standard_reply(SimulatedUsb& device, const Setup& setup);
// The device descriptor.
std::string device_descriptor(const Identity& identity);

}  // namespace mdof::drivers::usb
