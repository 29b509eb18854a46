#include "drivers/labjack_t7/registers.h"

#include <array>
#include <string>

#include "drivers/io/peer.h"

namespace mdof::drivers::labjack_t7 {
namespace {

constexpr std::chrono::milliseconds kReply{500};

}  // namespace

Result<Registers> Registers::connect(const Endpoint& to) {
  MDOF_TRY(ByteStream connection, connect_tcp(to, kConnect));
  const std::uint32_t peer = drivers::peer_ipv4(connection);
  MDOF_TRY(ModbusClient client, ModbusClient::over_tcp(std::move(connection), {kUnit, kReply}));
  return Registers(std::move(client), peer);
}

Status Registers::read(Register from, std::span<std::uint16_t> into) {
  auto done = client_.read_holding(from.address, into);
  return done ? Status{} : Status{explained("reading ", from, std::move(done.error()))};
}

Result<std::uint32_t> Registers::u32(Register at) {
  Words words{};
  MDOF_CHECK(read(at, words));
  return u32_of(words[0], words[1]);
}

Result<float> Registers::f32(Register at) {
  Words words{};
  MDOF_CHECK(read(at, words));
  return float_of(words[0], words[1]);
}

Status Registers::put(Register at, std::span<const std::uint16_t> words) {
  auto done = client_.write(at.address, words);
  return done ? Status{} : Status{explained("writing ", at, std::move(done.error()))};
}

Status Registers::write(Register at, std::uint32_t value) {
  return put(at, words_of(value));
}

Status Registers::write_f32(Register at, float value) {
  return put(at, words_of_float(value));
}

Status Registers::write_u16(Register at, std::uint16_t value) {
  return put(at, std::array{value});
}

// If trusted() is still true after an error, the device has sent an exception reply.
// LAST_ERR_DETAIL then contains the reason.
tl::unexpected<Error> Registers::explained(const char* what, Register at, Error error) {
  std::array<std::uint16_t, 1> code{};
  if (client_.trusted() && client_.read_holding(reg::last_error.address, code) && code[0] != 0)
    error.message += "; " + error_text(code[0]);
  return in_context(what + std::string(at.name), std::move(error));
}

}  // namespace mdof::drivers::labjack_t7
