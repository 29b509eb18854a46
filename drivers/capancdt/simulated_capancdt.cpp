#include "drivers/capancdt/simulated_capancdt.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

namespace mdof::drivers::capancdt {
namespace {

constexpr std::size_t kCommandIndex = 0, kDataIndex = 1;
constexpr std::int64_t kTypingLimit_ns = 10'000'000'000;
constexpr std::array kSampleTimes_us = {256,  512,   960,   1024,  2048,   4096,
                                        8192, 16384, 32768, 65536, 131072, 262144};
constexpr const char* kUnknown = "$UNKNOWN COMMAND\r\n";
constexpr const char* kWrong = "$WRONG PARAMETER\r\n";
constexpr std::string_view kGarbage = "\x01SAEM\x02SA";
constexpr int kArithmetic = 2;

// Returns the next shorter sample time that the controller supports.
int possible(int wanted_us) {
  const auto above = std::upper_bound(kSampleTimes_us.begin(), kSampleTimes_us.end(), wanted_us);
  return above == kSampleTimes_us.begin() ? *above : *(above - 1);
}

bool every(int n, int packet) {
  return n > 0 && packet % n == n - 1;
}

std::string joined(const std::vector<int>& numbers) {
  std::string list;
  for (const int each : numbers) list += (list.empty() ? "" : ",") + std::to_string(each);
  return list;
}

std::optional<int> number(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace

SimulatedCapancdt::SimulatedCapancdt(Senses senses, Options options)
    : senses_(std::move(senses)), options_(std::move(options)), counter_(options_.first_counter) {}

std::vector<SimulatedDevice::Port> SimulatedCapancdt::ports() const {
  return {{"command", kCommandPort}, {"data", options_.data_port}};
}

void SimulatedCapancdt::opened(std::size_t port, int client, std::int64_t now_ns) {
  if (port == kCommandIndex) {
    const std::string greeting =
        "Welcome\r\nDevice: " + options_.name + "\r\nSerial number: " + options_.serial + "\r\n";
    command_clients_[client] = {"", greeting, now_ns};
  } else if (!reader_) {
    reader_ = client;
    begin_stream(now_ns);
  }
}

void SimulatedCapancdt::closed(std::size_t port, int client) {
  if (port == kCommandIndex) command_clients_.erase(client);
  if (port == kDataIndex && reader_ == client) reader_.reset();
}

std::string SimulatedCapancdt::exchange(std::size_t port, int client, std::string_view received,
                                        std::int64_t now_ns) {
  if (port == kCommandIndex) return answer_commands(command_clients_[client], received, now_ns);
  return reader_ == client ? stream(now_ns) : "";
}

bool SimulatedCapancdt::hangs_up(std::size_t port, int client) {
  if (port != kDataIndex || reader_ != client) return false;
  return broken_ && out_.empty();
}

std::string SimulatedCapancdt::answer_commands(CommandClient& client, std::string_view received,
                                               std::int64_t now_ns) {
  std::string answer = std::exchange(client.greeting, "");
  if (now_ns - client.last_ns > kTypingLimit_ns) client.typed.clear();
  if (!received.empty()) client.last_ns = now_ns;
  for (const char c : received) {
    if (c != '\r') {
      if (c != '\n') client.typed += c;
      continue;
    }
    const std::string line = std::exchange(client.typed, "");
    const std::size_t begin = line.rfind('$');
    if (begin != std::string::npos && !options_.faults.mute) answer += dialogue(line.substr(begin));
  }
  return answer;
}

// Returns the reply to a command, with the kind of echo that the faults select.
std::string SimulatedCapancdt::dialogue(std::string_view command) {
  std::string text = reply(command);
  const std::string echo = std::string(command) + "\r";
  const std::size_t half = command.size() / 2;
  switch (options_.faults.echo) {
    case Echo::line:
      return echo + text;
    case Echo::reply:
      return text.starts_with(command) ? text : echo + text;
    case Echo::mixed:
      return echo.substr(0, half) + text + echo.substr(half);
    case Echo::none:
      return text;
  }
  return text;
}

std::string SimulatedCapancdt::reply(std::string_view command) {
  const std::string whole(command);
  if (command == "$VER") return whole + options_.name + ";" + options_.version + ";8010079\r\n";
  if (command.starts_with("$CHI")) return whole + channel_info(command.substr(4));
  if (const std::string text = query(command); !text.empty()) return whole + text + "OK\r\n";
  const auto value = number(command.substr(std::min<std::size_t>(4, command.size())));
  if (!value) return kUnknown;
  const auto more = change(command.substr(0, 4), *value);
  return more ? whole + *more + "OK\r\n" : *value < 0 ? kWrong : kUnknown;
}

std::string SimulatedCapancdt::query(std::string_view command) const {
  const Options& o = options_;
  if (command == "$STI?") return std::to_string(o.sample_time_us);
  if (command == "$TRG?") return std::to_string(o.trigger);
  if (command == "$AVT?") return std::to_string(o.averaging);
  if (command == "$AVN?") return std::to_string(o.averaged_values);
  if (command == "$ALP?" && o.supports_corrections) return std::to_string(o.low_pass);
  if (command == "$LIN?" && o.supports_corrections) return joined(o.linearisation);
  if (command == "$GDP") return std::to_string(o.data_port);
  if (command == "$COI")
    return "ANO" + std::to_string(o.article) + ",NAM" + o.name + ",SNO" + o.serial + ",OPT0,VER" +
           o.version;
  if (command != "$CHS") return "";
  std::vector<int> kinds;
  for (const auto& input : o.inputs) kinds.push_back(!input.present ? 0 : input.maths ? 2 : 1);
  return joined(kinds);
}

// Returns the reply without the command; nullopt: no such command or value.
std::optional<std::string> SimulatedCapancdt::change(std::string_view name, int value) {
  if (value < 0) return std::nullopt;
  if (name == "$STI") {
    options_.sample_time_us = possible(value);
    return "," + std::to_string(options_.sample_time_us);
  }
  if (name == "$TRG" && value <= 3)
    options_.trigger = value;
  else if (name == "$AVT" && value <= 4)
    options_.averaging = value;
  else if (name == "$AVN" && value >= 2 && value <= 8)
    options_.averaged_values = value;
  else
    return std::nullopt;
  return "";
}

std::string SimulatedCapancdt::channel_info(std::string_view which) const {
  const auto channel = number(which);
  if (!channel || *channel < 1 || *channel > static_cast<int>(options_.inputs.size()))
    return std::string("\r\n") + kWrong;
  const auto& input = options_.inputs[static_cast<std::size_t>(*channel - 1)];
  std::string text = ":ANO2800" + std::to_string(*channel) + ",NAMCS2,SNO" + options_.serial;
  if (options_.states_range)
    text += ",OFS0,RNG" + std::to_string(std::lround(input.range_um)) + ",UNT\xB5m";
  return text + "OK\r\n";
}

double SimulatedCapancdt::frame_ns() const {
  const int averaged = options_.averaging == kArithmetic ? options_.averaged_values : 1;
  return options_.sample_time_us * 1e3 * averaged / options_.faults.rate;
}

void SimulatedCapancdt::begin_stream(std::int64_t now_ns) {
  start_ns_ = now_ns;
  next_frame_ = 0;
  packets_ = 0;
  out_.clear();
  broken_ = false;
}

std::string SimulatedCapancdt::stream(std::int64_t now_ns) {
  const auto due = static_cast<std::int64_t>(static_cast<double>(now_ns - start_ns_) / frame_ns());
  while (options_.trigger == 0 && !broken_ && next_frame_ + options_.frames_per_packet <= due)
    send_packet();
  const std::size_t most = options_.faults.most_bytes;
  std::string now = out_.substr(0, most > 0 ? most : out_.size());
  out_.erase(0, now.size());
  return now;
}

void SimulatedCapancdt::send_packet() {
  const Faults& faults = options_.faults;
  if (packets_ == faults.reset_counter_at) counter_ = 0;
  const Packet packet = packet_of(next_frame_);
  std::string bytes = encode(packet, faults.sizes);
  if (faults.has_invalid_preamble) bytes[0] = 'M';
  if (every(faults.garbage_every, packets_)) out_ += kGarbage;
  if (!every(faults.lose_every, packets_)) out_ += bytes;
  if (every(faults.repeat_every, packets_)) out_ += bytes;
  broken_ = packets_ == faults.reset_connection_at;
  counter_ += counted(packet);
  next_frame_ += options_.frames_per_packet;
  ++packets_;
}

Packet SimulatedCapancdt::packet_of(std::int64_t first_frame) const {
  Packet packet;
  packet.article = options_.article;
  packet.serial = number(options_.serial).value_or(0);
  packet.counter = counter_;
  std::vector<std::size_t> inputs;
  for (std::size_t i = 0; i < options_.inputs.size(); ++i) {
    const int channel = static_cast<int>(i) + 1;
    if (!options_.inputs[i].present || gone(channel)) continue;
    inputs.push_back(i);
    packet.channel_bits |= channel_bit(channel);
  }
  for (int frame = 0; frame < options_.frames_per_packet; ++frame) {
    const double t_ns = static_cast<double>(first_frame + frame + 1) * frame_ns();
    for (const std::size_t input : inputs)
      packet.values.push_back(raw(input, start_ns_ + std::llround(t_ns)));
  }
  return packet;
}

bool SimulatedCapancdt::gone(int channel) const {
  const Faults& f = options_.faults;
  return channel == f.missing_channel && packets_ >= f.vanish_from &&
         packets_ < f.vanish_from + f.vanish_packets;
}

std::int32_t SimulatedCapancdt::raw(std::size_t input, std::int64_t t_ns) const {
  const double share = senses_(input, t_ns) / options_.inputs[input].range_um;
  return static_cast<std::int32_t>(std::lround(std::clamp(share, 0.0, 1.0) * kFullScale));
}

// Returns the step of the counter from this packet to the next packet.
std::uint32_t SimulatedCapancdt::counted(const Packet& packet) const {
  const auto frames = static_cast<std::uint32_t>(options_.frames_per_packet);
  const bool averages = options_.averaging == kArithmetic;
  switch (options_.faults.counter) {
    case CounterUnit::frame:
      return frames;
    case CounterUnit::value:
      return frames * static_cast<std::uint32_t>(packet.channels());
    case CounterUnit::sample:
      return frames * (averages ? static_cast<std::uint32_t>(options_.averaged_values) : 1);
    case CounterUnit::packet:
      return 1;
  }
  return frames;
}

Result<std::unique_ptr<SimulatedDevice>> make_simulated_capancdt(SimulatedWiring& wiring) {
  SimulatedCapancdt::Options options;
  options.inputs.assign(wiring.inputs().size(), {});
  std::vector<SensedInput> sensed;
  for (std::size_t i = 0; i < wiring.inputs().size(); ++i) {
    sensed.push_back(wiring.um(wiring.inputs()[i]));
    const auto probe = wiring.rig().probe_index(wiring.inputs()[i]);
    options.inputs[i].present = probe.has_value();
    if (probe) options.inputs[i].range_um = wiring.rig().probes[*probe].range_m * 1e6;
  }
  return std::make_unique<SimulatedCapancdt>(wiring.senses(std::move(sensed)), std::move(options));
}

}  // namespace mdof::drivers::capancdt
