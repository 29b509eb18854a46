// A Modbus slave on a virtual line that has one fault for some requests. The value of a register
// is calculated from the unit, the register and the number of received requests. Therefore the
// reply to another request, register or unit never has the expected value.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "drivers/modbus/protocol.h"
#include "tests/drivers/modbus_faults/virtual_line.h"

namespace mdof::drivers {

enum class FaultKind {
  late,         // reply is delayed by 1.01 ... 5 time-outs
  drip,         // reply arrives byte by byte during 1.05 ... 3 time-outs
  cut,          // the end of the reply is missing
  unit,         // reply has the number and the values of another unit
  function,     // reply has the number of another function
  length,       // valid frame with one register too many or too few
  byte_count,   // valid frame except for the byte count
  transaction,  // TCP: wrong transaction number
  header,       // TCP: wrong protocol or length
  crc,          // RTU: wrong CRC
  exception,    // exception 1 ... 11
  noise,        // RTU: random bytes before the reply
  twice,        // the same reply is sent twice
  foreign,      // RTU: traffic of other devices before the reply
  reset,        // TCP: connection is closed or reset, also within a reply
  half_open,    // slave sends nothing for up to ten time-outs
  kinds
};

struct Fault {
  FaultKind kind = FaultKind::late;
  int first = 5, requests = 1;  // first affected request, number of affected requests
  // True (RTU only): the slave ignores requests that arrive before it has sent its reply. False: it
  // queues these requests.
  bool ignores_when_busy = true;
  int most = modbus::kMostRegisters;  // rejects requests for more registers
};

class FaultySlave {
 public:
  using Framing = modbus::Framing;
  FaultySlave(Framing framing, int unit, std::int64_t timeout_ns, Fault fault, std::uint64_t seed)
      : framing_(framing), unit_(unit), timeout_ns_(timeout_ns), fault_(fault), random_(seed) {}

  static std::uint16_t word(int unit, int address, int request) {
    return static_cast<std::uint16_t>(request * 40503 + address * 7919 + unit * 257);
  }
  int requests() const { return requests_; }
  bool struck() const { return struck_; }
  // Time at which the last byte of the fault arrives, or at which the silence ends.
  std::int64_t fault_end_ns() const { return fault_end_ns_; }

  void received(VirtualLine& line, std::string_view adu) {
    ++requests_;
    const auto request = modbus::unwrap(framing_, adu);
    if (!request) return;
    if (world.now_ns < silent_until_ns_) return;
    if (world.now_ns < busy_until_ns_ && fault_.ignores_when_busy) return;
    const std::int64_t start_ns = std::max(world.now_ns, busy_until_ns_) + share(0.01, 0.1);
    modbus::Frame reply{request->transaction, static_cast<std::uint8_t>(unit_),
                        values(request->pdu, unit_, 0)};
    if (modbus::word_at(request->pdu, 3) > fault_.most)
      reply.pdu = {static_cast<char>(request->pdu[0] | modbus::kExceptionBit), 2};
    const bool strikes = requests_ >= fault_.first && requests_ < fault_.first + fault_.requests;
    const std::int64_t end_ns = strikes ? spoil(line, request->pdu, reply, start_ns)
                                        : send(line, modbus::wrap(framing_, reply), start_ns);
    busy_until_ns_ = std::max(busy_until_ns_, end_ns);
    if (!strikes) return;
    struck_ = true;
    fault_end_ns_ = std::max(fault_end_ns_, end_ns);
  }

 private:
  using Random = std::mt19937_64;
  double uniform(double from, double to) {
    return from + (to - from) * static_cast<double>(random_() >> 11) * 0x1p-53;
  }
  int whole(int from, int to) { return from + static_cast<int>(random_() % (to - from + 1u)); }
  std::int64_t share(double from, double to) {
    return std::llround(uniform(from, to) * static_cast<double>(timeout_ns_));
  }
  std::string values(const std::string& asked, int unit, int more) const {
    const int address = modbus::word_at(asked, 1), count = modbus::word_at(asked, 3) + more;
    std::string pdu{asked[0], static_cast<char>(2 * count)};
    for (int i = 0; i < count; ++i) modbus::append_word(pdu, word(unit, address + i, requests_));
    return pdu;
  }
  static std::int64_t send(VirtualLine& line, std::string bytes, std::int64_t at_ns) {
    line.deliver(at_ns, std::move(bytes));
    return at_ns;
  }
  std::string noise(int least) {
    std::string bytes;
    for (int n = whole(least, 12); n > 0; --n) bytes += static_cast<char>(random_());
    return bytes;
  }

  // Sends the reply with the fault. Returns the time at which its last byte arrives.
  std::int64_t spoil(VirtualLine& line, const std::string& asked, modbus::Frame reply,
                     std::int64_t at_ns) {
    std::string adu = modbus::wrap(framing_, reply);
    const auto wrapped = [&] { return modbus::wrap(framing_, reply); };
    switch (fault_.kind) {
      case FaultKind::late:
        return send(line, adu, std::max(at_ns, world.now_ns + share(1.01, 5)));
      case FaultKind::drip:
        return drip(line, adu, at_ns);
      case FaultKind::cut:
        return send(line, adu.substr(0, random_() % adu.size()), at_ns);
      case FaultKind::unit:
        reply.unit = static_cast<std::uint8_t>(unit_ % 247 + whole(1, 3));
        reply.pdu = values(asked, reply.unit, 0);
        return send(line, wrapped(), at_ns);
      case FaultKind::function:
        reply.pdu[0] = static_cast<char>(reply.pdu[0] ^ whole(1, 0x7F));
        return send(line, wrapped(), at_ns);
      case FaultKind::length:
        reply.pdu = values(asked, unit_, whole(0, 1) * 2 - 1);
        return send(line, wrapped(), at_ns);
      case FaultKind::byte_count:
        reply.pdu[1] = static_cast<char>(reply.pdu[1] ^ whole(1, 255));
        return send(line, wrapped(), at_ns);
      case FaultKind::transaction:
        reply.transaction = static_cast<std::uint16_t>(reply.transaction - whole(1, 5));
        return send(line, wrapped(), at_ns);
      case FaultKind::header:
        adu[static_cast<std::size_t>(whole(2, 5))] ^= static_cast<char>(whole(1, 255));
        return send(line, adu, at_ns);
      case FaultKind::crc:
        adu[adu.size() - static_cast<std::size_t>(whole(1, 2))] ^= static_cast<char>(whole(1, 255));
        return send(line, adu, at_ns);
      case FaultKind::exception:
        reply.pdu = {static_cast<char>(asked[0] | 0x80), static_cast<char>(whole(1, 11))};
        return send(line, wrapped(), at_ns);
      case FaultKind::noise:
        return send(line, noise(1) + adu, at_ns);
      case FaultKind::twice:
        return send(line, adu + adu, at_ns);
      case FaultKind::foreign: {
        const modbus::Frame other{0, static_cast<std::uint8_t>(unit_ % 247 + 1),
                                  values(asked, unit_ + 1, whole(0, 2))};
        return send(line, modbus::wrap(framing_, other) + adu, at_ns);
      }
      case FaultKind::reset:
        send(line, adu.substr(0, random_() % adu.size()), at_ns);
        line.hang_up(at_ns, whole(0, 1) == 0 ? 0 : ECONNRESET);
        return at_ns;
      default:
        silent_until_ns_ = world.now_ns + share(1, 10);
        return silent_until_ns_;
    }
  }
  std::int64_t drip(VirtualLine& line, const std::string& adu, std::int64_t at_ns) {
    const std::int64_t step_ns = share(1.05, 3) / static_cast<std::int64_t>(adu.size() - 1);
    for (const char byte : adu) line.deliver(at_ns += step_ns, std::string(1, byte));
    return at_ns;
  }

  Framing framing_;
  int unit_;
  std::int64_t timeout_ns_;
  Fault fault_;
  Random random_;
  int requests_ = 0;
  bool struck_ = false;
  std::int64_t busy_until_ns_ = 0, silent_until_ns_ = 0, fault_end_ns_ = 0;
};

}  // namespace mdof::drivers
