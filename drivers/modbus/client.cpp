#include "drivers/modbus/client.h"

#include <modbus/modbus.h>
#include <sys/select.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <utility>

#include "drivers/long_step.h"
#include "drivers/modbus/protocol.h"
#include "drivers/modbus/sentinels.h"

namespace mdof::drivers {
namespace {

using modbus::Answer;
using modbus::Framing;
using std::chrono::milliseconds;
using std::chrono::steady_clock;

// The longest delay of a reply that is assumed, in response time-outs. Delays of up to five
// time-outs were tested.
constexpr int kLatest_timeouts = 6;

using Context = std::unique_ptr<modbus_t, decltype(&::modbus_free)>;

// The library never opens the connection itself, so address and settings of the line have no
// effect.
Context new_context(Framing framing) {
  return {framing == Framing::tcp ? ::modbus_new_tcp("127.0.0.1", MODBUS_TCP_DEFAULT_PORT)
                                  : ::modbus_new_rtu("/dev/null", 19200, 'E', 8, 1),
          &::modbus_free};
}

std::string registers_text(const char* kind, int address, std::size_t count) {
  std::string text = std::string(kind) + (count == 1 ? " register " : " registers ");
  text += std::to_string(address);
  if (count > 1) text += "-" + std::to_string(address + static_cast<int>(count) - 1);
  return text;
}

}  // namespace

struct ModbusClient::Impl {
  ByteStream stream;
  Options options;
  Framing framing;
  Context context;
  modbus::Sentinels sentinels = {};
  std::array<std::uint8_t, MODBUS_MAX_ADU_LENGTH> adu = {};
  std::uint16_t transaction = 0;
  std::uint64_t rejected = 0;
  int exception = 0;
  // Replies to the requests of an earlier program may still arrive on an RTU line, so the line is
  // not trusted at the start.
  bool trusted = framing == Framing::tcp;
  steady_clock::time_point failed_at = steady_clock::now(), asked_at = failed_at,
                           heard_at = failed_at;

  Status configure();
  Result<Answer> ask(const char* what, int address, std::size_t count, const std::string& pdu);
  Result<Answer> ask_in_order(const std::string& pdu, int address, modbus::Shape shape);
  Result<Answer> exchange(const std::string& pdu);
  Status expect_silence(milliseconds wait);
  Status prove(int address, modbus::Shape regular);
  Result<Answer> refused(int code);
  void distrust();
  std::string why_no_reply(int rc) const;
};

Status ModbusClient::Impl::configure() {
  if (stream.fd() >= FD_SETSIZE)
    return io_error(stream.name() + ": file descriptor " + std::to_string(stream.fd()) +
                    " is too large for libmodbus; limit the number of open files of mdofd to " +
                    std::to_string(FD_SETSIZE) + " (LimitNOFILE=)");
  if (!context) return io_error(stream.name() + ": libmodbus: " + ::modbus_strerror(errno));
  const auto us = std::chrono::microseconds(options.response_timeout).count();
  const bool done =
      ::modbus_set_slave(context.get(), options.unit) == 0 &&
      ::modbus_set_socket(context.get(), stream.fd()) == 0 &&
      ::modbus_set_error_recovery(context.get(), MODBUS_ERROR_RECOVERY_NONE) == 0 &&
      ::modbus_set_byte_timeout(context.get(), 0, 0) == 0 &&
      ::modbus_set_response_timeout(context.get(), static_cast<std::uint32_t>(us / 1'000'000),
                                    static_cast<std::uint32_t>(us % 1'000'000)) == 0;
  if (done) return {};
  return bad_input(stream.name() + ": unit " + std::to_string(options.unit) + " or time-out " +
                   std::to_string(options.response_timeout.count()) +
                   " ms is out of range; units are from 1 to 247 (with TCP, also 255)");
}

// Sends a request for values. Errors begin with the device and the register.
Result<Answer> ModbusClient::Impl::ask(const char* what, int address, std::size_t count,
                                       const std::string& pdu) {
  const int function = pdu[0] == modbus::kReadInput ? modbus::kReadInput : modbus::kReadHolding;
  const modbus::Shape shape{function, static_cast<int>(count)};
  exception = 0;
  auto answer = ask_in_order(pdu, address, shape);
  const std::string place = stream.name() + " unit " + std::to_string(options.unit) + ": " +
                            registers_text(what, address, count);
  if (!answer) return in_context(place, answer.error());
  if (answer->exception == 0) return answer;
  ++rejected;
  exception = answer->exception;
  if (framing == Framing::rtu) distrust();
  return io_error(place + ": exception " + std::to_string(exception) + ", " +
                  modbus::exception_name(exception));
}

Result<Answer> ModbusClient::Impl::ask_in_order(const std::string& pdu, int address,
                                                modbus::Shape shape) {
  if (framing == Framing::tcp) {
    if (!trusted)
      return io_error(
          "after an error, replies may belong to other requests; open the connection again");
    return exchange(pdu);
  }
  if (!sentinels.add_regular(shape)) distrust();
  if (!trusted) MDOF_CHECK(prove(address, shape));
  const auto heard = std::chrono::floor<milliseconds>(steady_clock::now() - heard_at);
  MDOF_CHECK(expect_silence(std::max(milliseconds(0), options.gap - heard)));
  return exchange(pdu);
}

// Sends with ByteStream, which can send the bytes in several parts. Receives with the library's
// function for confirmations, because the library's functions for reading do not check the unit and
// the length of a TCP reply. Then checks the whole reply.
Result<Answer> ModbusClient::Impl::exchange(const std::string& pdu) {
  expect_long_step(2 * options.response_timeout);  // the time for sending and for receiving
  const modbus::Frame asked{++transaction, static_cast<std::uint8_t>(options.unit), pdu};
  asked_at = steady_clock::now();
  if (auto sent = stream.write(modbus::wrap(framing, asked), options.response_timeout); !sent) {
    distrust();
    return tl::unexpected(std::move(sent.error()));
  }
  const int size = ::modbus_receive_confirmation(context.get(), adu.data());
  auto answer = size <= 0 ? Result<Answer>(io_error(why_no_reply(size)))
                          : modbus::answer_to(asked, framing,
                                              {reinterpret_cast<const char*>(adu.data()),
                                               static_cast<std::size_t>(size)});
  heard_at = steady_clock::now();
  if (!answer) {
    ++rejected;
    distrust();
  }
  return answer;
}

// Waits for `wait`. Error: bytes arrive.
Status ModbusClient::Impl::expect_silence(milliseconds wait) {
  std::array<char, MODBUS_MAX_ADU_LENGTH> waste;
  auto came = stream.read(waste, wait);
  if (came && *came == 0) return {};
  heard_at = steady_clock::now();
  distrust();
  if (!came) return tl::unexpected(std::move(came.error()));
  ++rejected;
  return io_error(
      "bytes arrived without a request, from a late reply or from another master on the line");
}

Status ModbusClient::Impl::prove(int address, modbus::Shape regular) {
  MDOF_CHECK(expect_silence(options.response_timeout / 2));
  const modbus::Shape sentinel = sentinels.pick(regular);
  if (sentinel.count == 0)
    return io_error(
        "mdof cannot detect late replies from this device: a test request must ask for another "
        "number of registers than all requests of the profile, but the profile uses every possible "
        "number; remove a value from the profile");
  const int last = modbus::kLastAddress + 1 - sentinel.count;
  const auto pdu = modbus::read_request(static_cast<modbus::Function>(sentinel.function),
                                        std::min(address, last), sentinel.count);
  auto answer = exchange(pdu);
  if (answer && answer->exception != 0) answer = refused(answer->exception);
  if (!answer) {
    sentinels.failed();
    return tl::unexpected(std::move(answer.error()));
  }
  sentinels.proved();
  trusted = true;
  return {};
}

// An exception reply does not show to which request it belongs. Therefore an exception reply proves
// that the line is free of older replies only if all older replies must already have arrived.
Result<Answer> ModbusClient::Impl::refused(int code) {
  if (heard_at - failed_at >= kLatest_timeouts * options.response_timeout) return Answer{};
  ++rejected;
  return io_error("the device answered the test for late replies with exception " +
                  std::to_string(code) + ", " + modbus::exception_name(code));
}

void ModbusClient::Impl::distrust() {
  if (std::exchange(trusted, false)) failed_at = steady_clock::now();
}

std::string ModbusClient::Impl::why_no_reply(int rc) const {
  const int error = errno;
  if (rc == 0)
    return "the reply came from another unit; check that no two devices have the same address";
  if (error == ETIMEDOUT)
    return "no complete reply within " + std::to_string(options.response_timeout.count()) +
           " ms; check that the device is switched on, and check the unit number" +
           (framing == Framing::rtu ? ", the baud rate, the parity and the wiring"
                                    : " and the address");
  if (error == ECONNRESET) return "the device has closed the connection";
  return std::string("no valid reply: ") + ::modbus_strerror(error);
}

ModbusClient::ModbusClient(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
ModbusClient::~ModbusClient() = default;
ModbusClient::ModbusClient(ModbusClient&&) noexcept = default;
ModbusClient& ModbusClient::operator=(ModbusClient&&) noexcept = default;

Result<ModbusClient> ModbusClient::over_tcp(ByteStream connection, const Options& options) {
  auto impl = std::make_unique<Impl>(
      Impl{std::move(connection), options, Framing::tcp, new_context(Framing::tcp)});
  MDOF_CHECK(impl->configure());
  return ModbusClient(std::move(impl));
}

Result<ModbusClient> ModbusClient::over_rtu(ByteStream line, const Options& options) {
  auto impl = std::make_unique<Impl>(
      Impl{std::move(line), options, Framing::rtu, new_context(Framing::rtu)});
  MDOF_CHECK(impl->configure());
  return ModbusClient(std::move(impl));
}

namespace {

Status too_many(const char* what, int address, std::size_t count, int most) {
  if (count >= 1 && count <= static_cast<std::size_t>(most) && address >= 0 &&
      address + static_cast<int>(count) - 1 <= modbus::kLastAddress)
    return {};
  return bad_input(registers_text(what, address, count) + ": a request can contain 1 to " +
                   std::to_string(most) + " registers, with addresses from 0 to 65535");
}

}  // namespace

Status ModbusClient::read(int function, int address, std::span<std::uint16_t> into) {
  const char* what = function == modbus::kReadInput ? "input" : "holding";
  MDOF_CHECK(too_many(what, address, into.size(), modbus::kMostRegisters));
  const auto pdu = modbus::read_request(static_cast<modbus::Function>(function), address,
                                        static_cast<int>(into.size()));
  MDOF_TRY(const Answer answer, impl_->ask(what, address, into.size(), pdu));
  for (std::size_t i = 0; i < into.size(); ++i) into[i] = modbus::word_at(answer.registers, 2 * i);
  return {};
}

Status ModbusClient::read_holding(int address, std::span<std::uint16_t> into) {
  return read(modbus::kReadHolding, address, into);
}

Status ModbusClient::read_input(int address, std::span<std::uint16_t> into) {
  return read(modbus::kReadInput, address, into);
}

Status ModbusClient::write(int address, std::span<const std::uint16_t> values) {
  MDOF_CHECK(too_many("writing holding", address, values.size(), modbus::kMostWritten));
  return impl_
      ->ask("writing holding", address, values.size(), modbus::write_request(address, values))
      .map([](const Answer&) {});
}

bool ModbusClient::trusted() const {
  return impl_->trusted;
}
steady_clock::time_point ModbusClient::answered_at() const {
  return impl_->asked_at + (impl_->heard_at - impl_->asked_at) / 2;
}

std::uint64_t ModbusClient::rejected() const {
  return impl_->rejected;
}

int ModbusClient::exception() const {
  return impl_->exception;
}

}  // namespace mdof::drivers
