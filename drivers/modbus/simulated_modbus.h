// A simulated Modbus slave with the registers of a profile: by TCP, or by RTU over a serial line.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "drivers/modbus/profile.h"
#include "drivers/simulated_device.h"
#include "drivers/simulated_wiring.h"

namespace mdof::drivers {

// `senses(i, t)` is the i-th value of the profile in its unit (counts where it counts). Registers
// that the profile does not name answer with exception 2, as do writes with exception 1.
class SimulatedModbus final : public SimulatedDevice {
 public:
  struct Faults {
    enum class Kind { none, bad_crc, silence, exception, foreign_traffic, hang_up };
    Kind kind = Kind::none;
    int every = 1;      // strikes each n-th request
    int exception = 2;  // of Kind::exception
    int delay_ms = 0;   // of every reply
    // Registers that read so, whatever else they were: alarms, raw ends, range codes.
    std::map<std::pair<modbus::Function, int>, std::uint16_t> words = {};
  };
  struct Options {
    modbus::Profile profile;
    Faults faults = {};
  };
  SimulatedModbus(Senses senses, Options options);

  std::vector<Port> ports() const override;
  void opened(std::size_t port, int client, std::int64_t now_ns) override;
  void closed(std::size_t port, int client) override;
  std::string exchange(std::size_t port, int client, std::string_view received,
                       std::int64_t now_ns) override;
  bool hangs_up(std::size_t port, int client) override;

 private:
  struct Client {
    std::string inbox, outbox;
    std::int64_t heard_ns = 0, reply_at_ns = 0;
    bool gone = false;
  };
  bool take_request(Client& client, modbus::Frame& request) const;
  void answer(Client& client, const modbus::Frame& request, std::int64_t now_ns);
  std::string pdu_for(const std::string& request, std::int64_t now_ns);
  void sense(std::int64_t now_ns);

  Senses senses_;
  modbus::Profile profile_;
  Faults faults_;
  std::map<std::pair<modbus::Function, int>, std::uint16_t> registers_;
  std::map<int, Client> clients_;
  int requests_ = 0;
};

// As a plan of mdof-simulate has it. The values of a profile in its order, each in its unit.
Result<std::unique_ptr<SimulatedDevice>> make_simulated_modbus(SimulatedWiring& wiring);

}  // namespace mdof::drivers
