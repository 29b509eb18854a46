#include "drivers/capancdt/command_port.h"

#include <algorithm>
#include <array>
#include <utility>

namespace mdof::drivers::capancdt {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr int kWelcomeLines = 3;
constexpr std::size_t kMostReceived = 1 << 16;

}  // namespace

CommandPort::CommandPort(ByteStream stream, milliseconds reply_timeout)
    : stream_(std::move(stream)), reply_timeout_(reply_timeout) {}

Result<Welcome> CommandPort::welcome() {
  std::string received;
  std::array<char, 1024> bytes;
  const auto until = steady_clock::now() + reply_timeout_;
  while (steady_clock::now() < until && parse_welcome(received).lines < kWelcomeLines) {
    MDOF_TRY(const std::size_t n, stream_.read(bytes, reply_timeout_ / 2));
    if (n == 0) break;
    received.append(bytes.data(), n);
  }
  return parse_welcome(received);
}

Result<std::string> CommandPort::ask(const std::string& command) {
  MDOF_TRY(auto reply, exchange(command));
  if (reply.refused)
    return io_error("the controller refuses the command " + command + ": " + reply.text);
  return std::move(reply.text);
}

Result<std::optional<std::string>> CommandPort::ask_if_known(const std::string& command) {
  MDOF_TRY(auto reply, exchange(command));
  if (reply.refused) return std::nullopt;
  return std::move(reply.text);
}

// A command may be sent twice, because sending it again has no further effect.
Result<Reply> CommandPort::exchange(const std::string& command) {
  for (int tries = 0; tries < 2; ++tries) {
    MDOF_TRY(auto reply, try_once(command));
    if (reply) return std::move(*reply);
  }
  return io_error("no answer to " + command +
                  "; check that this is the command port of a capaNCDT controller, and end any "
                  "other program that uses this port");
}

Result<std::optional<Reply>> CommandPort::try_once(const std::string& command) {
  MDOF_TRY(const std::size_t old, stream_.drain(milliseconds(0), milliseconds(100)));
  static_cast<void>(old);
  MDOF_CHECK(stream_.write(command + "\r", reply_timeout_));
  std::string received;
  std::array<char, 1024> bytes;
  const auto until = steady_clock::now() + reply_timeout_;
  while (received.size() < kMostReceived) {
    const auto left = std::chrono::ceil<milliseconds>(until - steady_clock::now());
    MDOF_TRY(const std::size_t n, stream_.read(bytes, std::max(left, milliseconds(0))));
    if (n == 0) return std::nullopt;
    received.append(bytes.data(), n);
    if (auto reply = find_reply(command, received)) return reply;
  }
  return std::nullopt;
}

}  // namespace mdof::drivers::capancdt
