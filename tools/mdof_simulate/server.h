// Serves simulated devices on TCP ports and serial lines of this machine, in one thread.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "drivers/simulated_device.h"
#include "schema/result.h"

namespace mdof::simulate {

struct Served {
  std::string name;
  std::unique_ptr<drivers::SimulatedDevice> device;
  std::vector<int> tcp_ports;  // one for each of the device's TCP ports; 0: a free one
  double clock_ppm = 0;        // the device's clock is fast by so much
  double jitter_ms = 0;        // what it sends is held back by 0 to this
  std::int64_t seed = 1;       // of the jitter
};

// Thread-bound.
class Server {
 public:
  // Listens on `host`. Errors: an address or a port that cannot be had.
  static Result<Server> listen(std::vector<Served> devices, const std::string& host);
  ~Server();
  Server(Server&&) noexcept;

  // "capa-1 command 127.0.0.1:40123", "qsb serial /dev/pts/3": a line for each port.
  std::string addresses() const;
  // Until `stop`.
  void serve(const std::atomic<bool>& stop);

 private:
  struct Parts;
  explicit Server(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace mdof::simulate
