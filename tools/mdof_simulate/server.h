// Connects simulated devices to TCP ports, serial lines and USB ports of this computer, in one
// thread.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "drivers/simulated_device.h"
#include "schema/base/result.h"

namespace mdof::simulate {

struct Served {
  std::string name;
  std::unique_ptr<drivers::SimulatedDevice> device;
  bool uhid = false;           // USB only: use uhid instead of vhci_hcd.
  std::vector<int> tcp_ports;  // One for each TCP port of the device; 0: any free port.
  double clock_ppm = 0;        // Rate error of the device's clock, ppm; positive: fast.
  double jitter_ms = 0;        // Each packet is delayed by a random time from 0 to jitter_ms.
  std::int64_t seed = 1;       // Seed of the jitter.
};

// Thread-bound.
class Server {
 public:
  // Listens on `host` and plugs in the USB devices. Error: an address or a port is not available.
  static Result<Server> listen(std::vector<Served> devices, const std::string& host);
  ~Server();
  Server(Server&&) noexcept;

  // One line for each port, for example "capa-1 command 127.0.0.1:40123", "qsb serial /dev/pts/3"
  // or "encoders usb port 0".
  std::string addresses() const;
  // Runs the devices until `stop` is true or the last device is unplugged. Then unplugs all
  // devices.
  void serve(const std::atomic<bool>& stop);

 private:
  struct Parts;
  explicit Server(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace mdof::simulate
