// A device as it looks from its wires: the bytes a real one would send, without one. Served over
// sockets by tools/mdof-simulate, and driven directly by tests.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace mdof::drivers {

// What the inputs of a simulated device sense at a time on its own clock: volts, µm or counts, as
// the device's page says. Pure.
using Senses = std::function<double(std::size_t input, std::int64_t t_ns)>;

// Pure: no clock, no I/O; the time is handed in and never goes backwards. Thread-bound.
class SimulatedDevice {
 public:
  struct Port {
    std::string name;  // "command", "data"
    int number;        // TCP port of the real device; 0: a serial line
  };
  virtual ~SimulatedDevice() = default;
  virtual std::vector<Port> ports() const = 0;

  // A client has come to ports()[port], or has gone. `client` is unique.
  virtual void opened(std::size_t port, int client, std::int64_t now_ns) = 0;
  virtual void closed(std::size_t port, int client) = 0;
  // What this client is sent now, after `received` (maybe nothing) came from it. Called whenever
  // something came, and every millisecond or so besides.
  virtual std::string exchange(std::size_t port, int client, std::string_view received,
                               std::int64_t now_ns) = 0;
  // Every millisecond or so, whoever is there.
  virtual void turn(std::int64_t /*now_ns*/) {}
  // The device breaks this connection after what exchange() gave.
  virtual bool hangs_up(std::size_t port, int client) = 0;
};

}  // namespace mdof::drivers
