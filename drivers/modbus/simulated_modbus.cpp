#include "drivers/modbus/simulated_modbus.h"

#include <algorithm>
#include <cmath>

#include "drivers/modbus/readings.h"

namespace mdof::drivers {
namespace {

using modbus::Frame;
using modbus::Framing;
using modbus::Function;
using modbus::Value;

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kFrameEnd_ns = 50 * kMs;  // an incomplete frame is discarded at this age

// Returns the length of the request at the beginning of `bytes`; 0: not known yet.
std::size_t request_size(Framing framing, std::string_view bytes) {
  if (framing == Framing::tcp) return bytes.size() < 6 ? 0 : 6u + modbus::word_at(bytes, 4);
  if (bytes.size() < 8) return 0;
  return bytes[1] == modbus::kWrite ? 9u + static_cast<std::uint8_t>(bytes[6]) : 8u;
}

double lowest(const Value& value) {
  switch (value.type) {
    case modbus::Type::i16:
      return INT16_MIN;
    case modbus::Type::i32:
      return INT32_MIN;
    case modbus::Type::f32:
      return -INFINITY;
    default:
      return 0;
  }
}

double highest(const Value& value) {
  switch (value.type) {
    case modbus::Type::u16:
      return UINT16_MAX;
    case modbus::Type::i16:
      return INT16_MAX;
    case modbus::Type::u32:
      return UINT32_MAX;
    case modbus::Type::i32:
      return INT32_MAX;
    case modbus::Type::f32:
      return INFINITY;
  }
  return 0;
}

// Returns the contents of the register for a value: rounded, and then wrapped at the ring or
// limited to the range of the type.
double raw_of(const Value& value, double sensed) {
  const double raw = (sensed - value.offset) / value.scale;
  if (value.type == modbus::Type::f32) return raw;
  const double whole = std::round(raw);
  if (value.ring_bits > 0) {
    const double range = std::ldexp(1.0, value.ring_bits);
    return whole - range * std::floor(whole / range);
  }
  return std::clamp(whole, lowest(value), highest(value));
}

}  // namespace

SimulatedModbus::SimulatedModbus(Senses senses, Options options)
    : senses_(std::move(senses)),
      profile_(std::move(options.profile)),
      faults_(std::move(options.faults)) {
  const auto check = [this](const modbus::Check& wanted) {
    registers_[{wanted.at.function, wanted.at.address}] = wanted.equals;
  };
  std::vector<modbus::Span> spans;
  for (const Value& value : profile_.values) {
    if (value.check) check(*value.check);
    spans.push_back({value.at, registers_of(value.type)});
  }
  for (const auto& wanted : profile_.checks) check(wanted);
  for (const auto& status : profile_.statuses) spans.push_back({status.at, 1});
  for (const auto& [from, count] : plan_reads(std::move(spans), profile_.join_gap))
    for (int i = 0; i < count; ++i) registers_[{from.function, from.address + i}] = 0;
}

std::vector<SimulatedDevice::Port> SimulatedModbus::ports() const {
  return {{"modbus", profile_.framing == Framing::tcp ? profile_.port : 0}};
}

void SimulatedModbus::opened(std::size_t, int client, std::int64_t now_ns) {
  clients_[client] = Client{{}, {}, now_ns, 0, false};
}

void SimulatedModbus::closed(std::size_t, int client) {
  clients_.erase(client);
}

bool SimulatedModbus::hangs_up(std::size_t, int client) {
  return clients_[client].gone;
}

std::string SimulatedModbus::exchange(std::size_t, int id, std::string_view received,
                                      std::int64_t now_ns) {
  Client& client = clients_[id];
  if (!received.empty()) {
    client.inbox += received;
    client.heard_ns = now_ns;
  } else if (now_ns - client.heard_ns > kFrameEnd_ns) {
    client.inbox.clear();
  }
  for (Frame request; take_request(client, request);) answer(client, request, now_ns);
  if (client.outbox.empty() || now_ns < client.reply_at_ns) return {};
  return std::exchange(client.outbox, {});
}

// Removes complete requests from the inbox until a request is for this unit.
bool SimulatedModbus::take_request(Client& client, Frame& request) const {
  for (;;) {
    const std::size_t size = request_size(profile_.framing, client.inbox);
    if (size == 0 || client.inbox.size() < size) return false;
    auto frame = modbus::unwrap(profile_.framing, std::string_view(client.inbox).substr(0, size));
    client.inbox.erase(0, frame ? size : std::string::npos);
    if (!frame || frame->unit != profile_.unit) continue;
    request = std::move(*frame);
    return true;
  }
}

void SimulatedModbus::answer(Client& client, const Frame& request, std::int64_t now_ns) {
  using Kind = SimulatedModbus::Faults::Kind;
  const bool strikes = ++requests_ % std::max(1, faults_.every) == 0;
  const Kind fault = strikes ? faults_.kind : Kind::none;
  client.reply_at_ns = now_ns + faults_.delay_ms * kMs;
  Frame reply{request.transaction, request.unit, pdu_for(request.pdu, now_ns)};
  if (fault == Kind::silence) return;
  if (fault == Kind::hang_up) client.gone = true;
  if (fault == Kind::exception)
    reply.pdu = {static_cast<char>(request.pdu[0] | modbus::kExceptionBit),
                 static_cast<char>(faults_.exception)};
  std::string adu = modbus::wrap(profile_.framing, reply);
  if (fault == Kind::bad_crc) adu.back() = static_cast<char>(adu.back() ^ 0x55);
  if (fault == Kind::foreign_traffic) {
    reply.unit = static_cast<std::uint8_t>(reply.unit + 1);
    adu.insert(0, modbus::wrap(profile_.framing, reply));
  }
  client.outbox += adu;
}

std::string SimulatedModbus::pdu_for(const std::string& request, std::int64_t now_ns) {
  const auto refuse = [&](int code) {
    return std::string{static_cast<char>(request[0] | modbus::kExceptionBit),
                       static_cast<char>(code)};
  };
  if (request[0] != modbus::kReadHolding && request[0] != modbus::kReadInput) return refuse(1);
  if (request.size() != 5) return refuse(3);
  const auto function = static_cast<Function>(request[0]);
  const int address = modbus::word_at(request, 1), count = modbus::word_at(request, 3);
  if (count < 1 || count > modbus::kMostRegisters) return refuse(3);
  sense(now_ns);
  std::string pdu{request[0], static_cast<char>(2 * count)};
  for (int i = 0; i < count; ++i) {
    const auto found = registers_.find({function, address + i});
    if (found == registers_.end()) return refuse(2);
    modbus::append_word(pdu, found->second);
  }
  return pdu;
}

void SimulatedModbus::sense(std::int64_t now_ns) {
  for (std::size_t i = 0; i < profile_.values.size(); ++i) {
    const Value& value = profile_.values[i];
    int address = value.at.address;
    for (const std::uint16_t word : modbus::encode(value, raw_of(value, senses_(i, now_ns))))
      registers_[{value.at.function, address++}] = word;
  }
  for (const auto& [at, word] : faults_.words) registers_[at] = word;
}

Result<std::unique_ptr<SimulatedDevice>> make_simulated_modbus(SimulatedWiring& wiring) {
  const auto& inputs = wiring.inputs();
  MDOF_TRY(auto profile, modbus::load_profile(wiring.table().string("profile"), wiring.folder()));
  if (inputs.size() > profile.values.size())
    wiring.table().reject("inputs", "has more entries than the " +
                                        std::to_string(profile.values.size()) +
                                        " values of the profile");
  std::vector<SensedInput> sensed;
  for (std::size_t i = 0; i < std::min(inputs.size(), profile.values.size()); ++i) {
    const Unit unit = profile.values[i].unit;
    sensed.push_back(unit == Unit::volt ? wiring.volt(inputs[i])
                     : unit == Unit::um ? wiring.um(inputs[i])
                                        : wiring.counts(inputs[i]));
  }
  return std::make_unique<SimulatedModbus>(wiring.senses(std::move(sensed)),
                                           SimulatedModbus::Options{std::move(profile), {}});
}

}  // namespace mdof::drivers
