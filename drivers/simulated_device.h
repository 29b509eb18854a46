// A simulated device: it sends the bytes that a real one would send. Beside each driver stands the
// simulated twin of its device, simulated_<driver>.h: a class Simulated<Device>, made from what its
// inputs sense and from its Options, which hold its Faults. mdof-simulate serves twins on TCP
// ports, serial lines, the USB and in files; tests do so too, or call them directly.
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

// What the inputs of a simulated device sense at a time on its own clock: volts, µm or counts, as
// the device's page says. Pure.
using Senses = std::function<double(std::size_t input, std::int64_t t_ns)>;

// No clock; the time is handed in and never goes backwards. Thread-bound. A device overrides what
// belongs to its own wires: ports, or on_usb(), or turn() alone where it is a folder of files.
class SimulatedDevice {
 public:
  struct Port {
    std::string name;  // "command", "data"
    int number;        // TCP port of the real device; 0: a serial line
  };
  virtual ~SimulatedDevice() = default;
  virtual std::vector<Port> ports() const { return {}; }

  // A client has connected to ports()[port], or has gone. `client` is unique.
  virtual void opened(std::size_t /*port*/, int /*client*/, std::int64_t /*now_ns*/) {}
  virtual void closed(std::size_t /*port*/, int /*client*/) {}
  // What this client is sent now, after `received` (maybe nothing) came from it. Called whenever
  // something came, and every millisecond or so besides.
  virtual std::string exchange(std::size_t /*port*/, int /*client*/, std::string_view /*received*/,
                               std::int64_t /*now_ns*/) {
    return "";
  }
  // The device breaks this connection after what exchange() gave.
  virtual bool hangs_up(std::size_t /*port*/, int /*client*/) { return false; }

  // The device as it looks from the USB; nullptr: it is not on the USB.
  virtual usb::SimulatedUsb* on_usb() { return nullptr; }
  // Every millisecond or so, whoever is there.
  virtual void turn(std::int64_t /*now_ns*/) {}
};

}  // namespace mdof::drivers
