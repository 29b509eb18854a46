#include "drivers/modbus/protocol.h"

#include <array>
#include <cassert>

namespace mdof::drivers::modbus {
namespace {

constexpr std::size_t kTcpHeader = 7;  // transaction, protocol, length, unit
constexpr std::size_t kEchoed = 5;     // function, address and count in the reply to a write
constexpr std::uint16_t kPolynomial = 0xA001;

constexpr std::array<std::uint16_t, 256> crc_table() {
  std::array<std::uint16_t, 256> table{};
  for (unsigned i = 0; i < 256; ++i) {
    unsigned crc = i;
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1) != 0 ? kPolynomial : 0u);
    table[i] = static_cast<std::uint16_t>(crc);
  }
  return table;
}
constexpr auto kCrcTable = crc_table();

std::uint8_t byte_at(std::string_view bytes, std::size_t offset) {
  return static_cast<std::uint8_t>(bytes[offset]);
}

std::string not_this(const char* what, unsigned got, unsigned wanted) {
  return std::string("the reply has ") + what + " " + std::to_string(got) + " instead of " +
         std::to_string(wanted);
}

Result<Frame> unwrap_tcp(std::string_view adu) {
  if (adu.size() < kTcpHeader + 1) return io_error("the reply is incomplete");
  if (word_at(adu, 2) != 0) return io_error("the reply belongs to another protocol");
  if (word_at(adu, 4) != adu.size() - 6)
    return io_error(not_this("length", word_at(adu, 4), static_cast<unsigned>(adu.size() - 6)));
  return Frame{word_at(adu, 0), byte_at(adu, 6), std::string(adu.substr(kTcpHeader))};
}

Result<Frame> unwrap_rtu(std::string_view adu) {
  if (adu.size() < 4) return io_error("the reply is incomplete");
  const auto body = adu.substr(0, adu.size() - 2);
  const unsigned crc = byte_at(adu, body.size()) | byte_at(adu, body.size() + 1) << 8u;
  if (crc != crc16(body)) return io_error("the CRC of the reply is wrong");
  return Frame{0, byte_at(adu, 0), std::string(body.substr(1))};
}

Result<Answer> read_answer(std::string_view asked, std::string_view pdu) {
  const std::size_t wanted = std::size_t{2} * word_at(asked, 3);
  if (pdu.size() < 2 || byte_at(pdu, 1) != pdu.size() - 2 || pdu.size() - 2 != wanted)
    return io_error(not_this("byte count", static_cast<unsigned>(pdu.size()) - 2,
                             static_cast<unsigned>(wanted)));
  return Answer{0, std::string(pdu.substr(2))};
}

}  // namespace

std::uint16_t crc16(std::string_view bytes) {
  unsigned crc = 0xFFFF;
  for (const char c : bytes)
    crc = (crc >> 8) ^ kCrcTable[(crc ^ static_cast<std::uint8_t>(c)) & 0xFF];
  return static_cast<std::uint16_t>(crc);
}

std::uint16_t word_at(std::string_view bytes, std::size_t offset) {
  return static_cast<std::uint16_t>(byte_at(bytes, offset) << 8 | byte_at(bytes, offset + 1));
}

void append_word(std::string& bytes, unsigned word) {
  bytes += static_cast<char>(word >> 8 & 0xFF);
  bytes += static_cast<char>(word & 0xFF);
}

std::string wrap(Framing framing, const Frame& frame) {
  std::string adu;
  if (framing == Framing::tcp) {
    append_word(adu, frame.transaction);
    append_word(adu, 0);
    append_word(adu, static_cast<unsigned>(frame.pdu.size() + 1));
  }
  adu += static_cast<char>(frame.unit);
  adu += frame.pdu;
  if (framing == Framing::rtu) {
    const std::uint16_t crc = crc16(adu);
    append_word(adu, static_cast<unsigned>((crc & 0xFF) << 8 | crc >> 8));
  }
  return adu;
}

Result<Frame> unwrap(Framing framing, std::string_view adu) {
  return framing == Framing::tcp ? unwrap_tcp(adu) : unwrap_rtu(adu);
}

std::string read_request(Function function, int address, int count) {
  assert(count >= 1 && count <= kMostRegisters);
  std::string pdu(1, static_cast<char>(function));
  append_word(pdu, static_cast<unsigned>(address));
  append_word(pdu, static_cast<unsigned>(count));
  return pdu;
}

std::string write_request(int address, std::span<const std::uint16_t> values) {
  assert(!values.empty() && values.size() <= kMostWritten);
  std::string pdu(1, static_cast<char>(kWrite));
  append_word(pdu, static_cast<unsigned>(address));
  append_word(pdu, static_cast<unsigned>(values.size()));
  pdu += static_cast<char>(2 * values.size());
  for (const std::uint16_t value : values) append_word(pdu, value);
  return pdu;
}

Result<Answer> answer_to(const Frame& asked, Framing framing, std::string_view adu) {
  MDOF_TRY(const Frame reply, unwrap(framing, adu));
  if (framing == Framing::tcp && reply.transaction != asked.transaction)
    return io_error(not_this("transaction", reply.transaction, asked.transaction));
  if (reply.unit != asked.unit) return io_error(not_this("unit", reply.unit, asked.unit));
  const unsigned function = byte_at(asked.pdu, 0), got = byte_at(reply.pdu, 0);
  if (got == (function | kExceptionBit) && reply.pdu.size() == 2 && reply.pdu[1] != 0)
    return Answer{byte_at(reply.pdu, 1), {}};
  if (got != function) return io_error(not_this("function", got, function));
  if (function == kReadHolding || function == kReadInput) return read_answer(asked.pdu, reply.pdu);
  if (reply.pdu != asked.pdu.substr(0, kEchoed))
    return io_error("the reply confirms a write that was not requested");
  return Answer{};
}

const char* exception_name(int code) {
  constexpr const char* kNames[] = {"",
                                    "illegal function",
                                    "illegal data address",
                                    "illegal data value",
                                    "server device failure",
                                    "acknowledge",
                                    "server device busy",
                                    "negative acknowledge",
                                    "memory parity error",
                                    "",
                                    "gateway path unavailable",
                                    "gateway target device failed to respond"};
  const bool known = code > 0 && code < static_cast<int>(std::size(kNames)) && *kNames[code];
  return known ? kNames[code] : "unknown";
}

}  // namespace mdof::drivers::modbus
