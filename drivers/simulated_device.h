// A simulated device sends the same bytes as the real device. Each driver's folder contains the
// simulated twin of its device (simulated_<driver>.h): a class Simulated<Device>. Its constructor
// takes the signals at its inputs and its Options; the Options contain the Faults. mdof-simulate
// connects the twins to TCP ports, serial lines, USB and files. Tests do the same, or call the twin
// directly.
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

// Signal at an input of a simulated device at the time t_ns. The unit is V, µm or counts; the
// header of the device states it. Pure.
using Senses = std::function<double(std::size_t input, std::int64_t t_ns)>;

// A simulated device has no clock: the caller passes the time, which never decreases. Thread-bound.
// A derived class overrides only the functions of its connection: the functions with ports, or
// on_usb(), or turn() alone if the device is a folder of files.
class SimulatedDevice {
 public:
  struct Port {
    std::string name;  // "command", "data"
    int number;        // TCP port of the real device; 0: the device has a serial line
  };
  virtual ~SimulatedDevice() = default;
  virtual std::vector<Port> ports() const { return {}; }

  // A client has connected to ports()[port], or has disconnected. Each `client` number is used
  // once.
  virtual void opened(std::size_t /*port*/, int /*client*/, std::int64_t /*now_ns*/) {}
  virtual void closed(std::size_t /*port*/, int /*client*/) {}
  // Takes the bytes `received` (may be empty) from this client and returns the bytes for this
  // client. Called whenever bytes arrive, and about every millisecond.
  virtual std::string exchange(std::size_t /*port*/, int /*client*/, std::string_view /*received*/,
                               std::int64_t /*now_ns*/) {
    return "";
  }
  // Whether the device closes this connection after the bytes that exchange() returned are sent.
  virtual bool hangs_up(std::size_t /*port*/, int /*client*/) { return false; }

  // The USB interface of the device; nullptr: the device has no USB.
  virtual usb::SimulatedUsb* on_usb() { return nullptr; }
  // Called about every millisecond, even if no client is connected.
  virtual void turn(std::int64_t /*now_ns*/) {}
};

}  // namespace mdof::drivers
