// A simulated capaNCDT 6200 controller with its Ethernet ports.
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

// The signals at the inputs (Senses) are in µm; they are limited to the range. The sample times are
// 256 µs times 1, 2, 4, 8 and so on, and 960 µs; a requested sample time is changed to the next
// shorter one. Only one client receives data from the data port.
class SimulatedCapancdt final : public SimulatedDevice {
 public:
  // How commands are echoed. According to the manual, the controller echoes every character
  // immediately, and the reply contains the command again.
  enum class Echo {
    line,   // the command, then the reply, which contains the command
    reply,  // the command once; its echo is the beginning of the reply
    mixed,  // the reply comes before the last characters of the echo
    none,
  };

  // A fault lasts as long as the device is used, unless its comment states the packets that have
  // the fault.
  struct Faults {
    SizeOrder sizes = SizeOrder::bytes_per_frame_first;
    CounterUnit counter = CounterUnit::frame;
    Echo echo = Echo::line;
    int lose_every = 0;                 // each n-th packet is not sent; 0: all packets are sent
    int repeat_every = 0;               // each n-th packet is sent twice
    int garbage_every = 0;              // invalid bytes before each n-th packet
    bool has_invalid_preamble = false;  // all sent data are invalid, so that they contain no packet
    // largest number of data bytes that exchange() returns; 0: no limit
    std::size_t most_bytes = 0;
    // This channel is missing in `vanish_packets` packets, from packet `vanish_from` on.
    int missing_channel = 0;
    int vanish_from = 0, vanish_packets = 0;
    int reset_counter_at = -1;     // packet at which the counter restarts
    int reset_connection_at = -1;  // packet after which the data connection is closed
    bool mute = false;             // commands are read, but get no reply
    double rate = 1;               // factor by which the actual rate exceeds the stated rate
  };

  struct Options {
    struct Input {
      bool present = true, maths = false;
      double range_um = 2000;
    };
    std::string name = "DT6220", version = "V1.2a", serial = "1001";
    std::int32_t article = 2303025;
    std::vector<Input> inputs = std::vector<Input>(4);
    bool states_range = true;   // the reply to $CHI contains the range
    int data_port = kDataPort;  // port in the reply to $GDP
    int frames_per_packet = 1;
    std::uint32_t first_counter = 0;
    int sample_time_us = 960, trigger = 0, averaging = 0, averaged_values = 2;
    std::vector<int> linearisation = std::vector<int>(4);  // setting of each input
    int low_pass = 0;
    bool supports_corrections = true;  // supports $LIN? and $ALP?
    Faults faults = {};
  };

  SimulatedCapancdt(Senses senses, Options options);

  std::vector<Port> ports() const override;  // port 0: command; port 1: data
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
  std::optional<int> reader_;  // client number at the data port
  std::int64_t start_ns_ = 0, next_frame_ = 0;
  std::uint32_t counter_ = 0;
  int packets_ = 0;  // number of packets that were made
  std::string out_;
  bool broken_ = false;
};

// Makes the twin from a plan of mdof-simulate. The readings are in µm; the controller states the
// ranges.
Result<std::unique_ptr<SimulatedDevice>> make_simulated_capancdt(SimulatedWiring& wiring);

}  // namespace mdof::drivers::capancdt
