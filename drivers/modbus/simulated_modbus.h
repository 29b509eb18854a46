// A simulated Modbus slave with the registers of a profile, over TCP, or over RTU on a serial line.
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

// `senses(i, t)` returns value i of the profile in its unit (counts for a counter). A read of a
// register that is not in the profile is answered with exception 2, a write with exception 1.
class SimulatedModbus final : public SimulatedDevice {
 public:
  struct Faults {
    enum class Kind { none, bad_crc, silence, exception, foreign_traffic, hang_up };
    Kind kind = Kind::none;
    int every = 1;      // each n-th request has the fault
    int exception = 2;  // exception code for Kind::exception
    int delay_ms = 0;   // delay of every reply
    // Registers with fixed contents: for alarms, ends of the range and range codes.
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

// Makes the twin from a plan of mdof-simulate. The inputs are the values of a profile, in the order
// of the profile; each input has the unit of its value.
Result<std::unique_ptr<SimulatedDevice>> make_simulated_modbus(SimulatedWiring& wiring);

}  // namespace mdof::drivers
