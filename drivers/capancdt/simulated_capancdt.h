// A simulated capaNCDT 6200 controller, as a program sees it over Ethernet.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/capancdt/frame_counter.h"
#include "drivers/capancdt/options.h"
#include "drivers/capancdt/protocol.h"
#include "drivers/simulated_device.h"
#include "drivers/simulated_wiring.h"

namespace mdof::drivers::capancdt {

// Inputs sense µm, clamped to the range. Its sample times are 256 µs and its multiples by 2, 4, 8
// and so on, and 960 µs; the next shorter is taken. One client has the data port; others get
// nothing.
class SimulatedCapancdt final : public SimulatedDevice {
 public:
  // How a command is echoed. The manual: every character at once, and the reply repeats the
  // command.
  enum class Echo {
    line,   // the command, then the reply with the command in it
    reply,  // the command once: what is echoed is the beginning of the reply
    mixed,  // the reply comes before the last characters of the echo
    none,
  };

  // Each as long as the device is in use, unless it says when.
  struct Faults {
    SizeOrder sizes = SizeOrder::bytes_per_frame_first;
    CounterUnit counter = CounterUnit::frame;
    Echo echo = Echo::line;
    int lose_every = 0;           // packet is not sent; 0: none
    int repeat_every = 0;         // packet is sent twice
    int garbage_every = 0;        // packet has bytes that are none before it
    bool spoil_preamble = false;  // nothing that is sent is a packet
    std::size_t most_bytes = 0;   // that exchange() gives of the data at a time; 0: all
    int vanishing = 0;            // channel that is gone for `vanish_packets` from this packet on
    int vanish_from = 0, vanish_packets = 0;
    int reset_counter_at = -1;     // packet whose counter begins anew
    int reset_connection_at = -1;  // packet after which the data connection is broken
    bool mute = false;             // commands are taken and not answered
    double rate = 1;               // samples come so much faster than the sample time says
  };

  struct Options {
    struct Input {
      bool present = true, maths = false;
      double range_um = 2000;
    };
    std::string name = "DT6220", version = "V1.2a", serial = "1001";
    std::int32_t article = 2303025;
    std::vector<Input> inputs = std::vector<Input>(4);
    bool states_range = true;   // by $CHI
    int data_port = kDataPort;  // that $GDP says
    int frames_per_packet = 1;
    std::uint32_t first_counter = 0;
    int sample_time_us = 960, trigger = 0, averaging = 0, averaged_values = 2;
    std::vector<int> linearisation = std::vector<int>(4);  // of each input
    int low_pass = 0;
    bool knows_corrections = true;  // $LIN?, $ALP?
    Faults faults = {};
  };

  SimulatedCapancdt(Senses senses, Options options);

  std::vector<Port> ports() const override;  // command, data
  void opened(std::size_t port, int client, std::int64_t now_ns) override;
  void closed(std::size_t port, int client) override;
  std::string exchange(std::size_t port, int client, std::string_view received,
                       std::int64_t now_ns) override;
  bool hangs_up(std::size_t port, int client) override;

 private:
  struct CommandClient {
    std::string typed, greeting;
    std::int64_t last_ns = 0;
  };
  std::string answer_commands(CommandClient& client, std::string_view received,
                              std::int64_t now_ns);
  std::string dialogue(std::string_view command);
  std::string reply(std::string_view command);
  std::string query(std::string_view command) const;
  std::optional<std::string> change(std::string_view name, int value);
  std::string channel_info(std::string_view number) const;

  std::string stream(std::int64_t now_ns);
  void begin_stream(std::int64_t now_ns);
  void send_packet();
  Packet packet_of(std::int64_t first_frame) const;
  bool gone(int number) const;
  std::int32_t raw(std::size_t input, std::int64_t t_ns) const;
  std::uint32_t counted(const Packet& packet) const;
  double frame_ns() const;

  Senses senses_;
  Options options_;
  std::map<int, CommandClient> command_clients_;
  std::optional<int> reader_;  // client that has the data port
  std::int64_t start_ns_ = 0, next_frame_ = 0;
  std::uint32_t counter_ = 0;
  int packets_ = 0;  // made
  std::string out_;
  bool broken_ = false;
};

// As a plan of mdof-simulate has it. µm as they are, and ranges that the controller states.
Result<std::unique_ptr<SimulatedDevice>> make_simulated_capancdt(SimulatedWiring& wiring);

}  // namespace mdof::drivers::capancdt
