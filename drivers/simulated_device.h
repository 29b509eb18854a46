// A simulated device sends the same bytes as the real device. Each driver's folder contains the
// simulated twin of its device (simulated_<driver>.h): a class Simulated<Device>, made from the
// signals at its inputs and from its Options, which contain its Faults. mdof-simulate serves twins
// on TCP ports, serial lines, USB and in files; tests do so too, or call twins directly.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace mdof::drivers {

namespace usb {
class SimulatedUsb;
}

// Signal at an input of a simulated device at a time of the device's clock, in volts, µm or counts;
// the header of the device states the unit. Pure.
using Senses = std::function<double(std::size_t input, std::int64_t t_ns)>;

// Has no clock: the caller gives the time, which never decreases. Thread-bound. A device overrides
// only the functions of its connection: ports, or on_usb(), or only turn() if it is a folder of
// files.
class SimulatedDevice {
 public:
  struct Port {
    std::string name;  // "command", "data"
    int number;        // TCP port of the real device; 0: a serial line
  };
  virtual ~SimulatedDevice() = default;
  virtual std::vector<Port> ports() const { return {}; }

  // A client has connected to ports()[port], or has disconnected. `client` is unique.
  virtual void opened(std::size_t /*port*/, int /*client*/, std::int64_t /*now_ns*/) {}
  virtual void closed(std::size_t /*port*/, int /*client*/) {}
  // Returns the bytes for this client, after it has sent `received` (may be empty). Called whenever
  // bytes arrive, and about every millisecond.
  virtual std::string exchange(std::size_t /*port*/, int /*client*/, std::string_view /*received*/,
                               std::int64_t /*now_ns*/) {
    return "";
  }
  // Whether the device closes this connection after the bytes from exchange() are sent.
  virtual bool hangs_up(std::size_t /*port*/, int /*client*/) { return false; }

  // The USB side of the device; nullptr: it is not a USB device.
  virtual usb::SimulatedUsb* on_usb() { return nullptr; }
  // Called about every millisecond, even without clients.
  virtual void turn(std::int64_t /*now_ns*/) {}
};

}  // namespace mdof::drivers
