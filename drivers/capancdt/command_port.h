// Commands and replies on the command port of a controller.
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "drivers/capancdt/replies.h"
#include "drivers/io/byte_stream.h"
#include "schema/base/result.h"

namespace mdof::drivers::capancdt {

// Thread-bound. Each command blocks for at most twice `reply_timeout`.
class CommandPort {
 public:
  CommandPort(ByteStream stream, std::chrono::milliseconds reply_timeout);
  // The text that the controller sends when a client connects; empty: it sent none.
  Result<Welcome> welcome();
  // Returns the result. Errors: refused (with the controller's text), no answer after a second try,
  // disconnected.
  Result<std::string> ask(const std::string& command);
  // nullopt: the controller does not know the command.
  Result<std::optional<std::string>> ask_if_known(const std::string& command);

 private:
  Result<Reply> exchange(const std::string& command);
  Result<std::optional<Reply>> try_once(const std::string& command);

  ByteStream stream_;
  std::chrono::milliseconds reply_timeout_;
};

}  // namespace mdof::drivers::capancdt
