// Sends commands to the command port of a controller and reads the replies.
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
  // Reads the text that the controller sends when a client connects. The result is empty if the
  // controller sends none.
  Result<Welcome> welcome();
  // Returns the result of a command. Errors: the controller rejects the command (the error contains
  // its text); no reply after a second attempt; the connection is closed.
  Result<std::string> ask(const std::string& command);
  // As ask(); nullopt: the controller does not know the command.
  Result<std::optional<std::string>> ask_if_known(const std::string& command);

 private:
  Result<Reply> exchange(const std::string& command);
  Result<std::optional<Reply>> try_once(const std::string& command);

  ByteStream stream_;
  std::chrono::milliseconds reply_timeout_;
};

}  // namespace mdof::drivers::capancdt
