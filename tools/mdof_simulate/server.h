// Serves simulated devices on TCP ports, serial lines and the USB of this machine, in one thread.
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
  bool uhid = false;           // on the USB: through uhid instead of vhci_hcd
  std::vector<int> tcp_ports;  // one for each of the device's TCP ports; 0: a free one
  double clock_ppm = 0;        // the device's clock is fast by so much
  double jitter_ms = 0;        // what it sends is held back by 0 to this
  std::int64_t seed = 1;       // of the jitter
};

// Thread-bound.
class Server {
 public:
  // Listens on `host` and plugs in. Errors: an address or a port that cannot be had.
  static Result<Server> listen(std::vector<Served> devices, const std::string& host);
  ~Server();
  Server(Server&&) noexcept;

  // "capa-1 command 127.0.0.1:40123", "qsb serial /dev/pts/3", "encoders usb port 0": a line for
  // each port.
  std::string addresses() const;
  // Until `stop`, or until the last device has gone. Then all are unplugged.
  void serve(const std::atomic<bool>& stop);

 private:
  struct Parts;
  explicit Server(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace mdof::simulate
