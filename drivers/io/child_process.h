// Starts a program and reads its standard output. Opens a FIFO to which a separate program writes.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <csignal>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "drivers/io/byte_stream.h"
#include "schema/base/result.h"

namespace mdof::drivers {

// Thread-bound. The destructor ends all processes in the program's process group: it sends SIGTERM,
// and SIGKILL 0.5 s later.
class ChildProcess {
 public:
  // `command[0]` is searched in PATH unless it contains '/'; no shell is used. The program runs in
  // `folder`; its standard input is empty. Error: the program cannot be started.
  static Result<std::unique_ptr<ChildProcess>> start(const std::vector<std::string>& command,
                                                     const std::string& folder);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  ByteStream& output() { return output_; }
  // Reads the standard error of the program and keeps the last line. Call it regularly: the program
  // blocks when 64 KiB are unread.
  void take_errors();
  // Text that states how the program has ended: "has exited with status 3; its last line of
  // standard error: ...". Call it after the output has ended. Waits briefly for the exit.
  std::string exit_description();

 private:
  ChildProcess(pid_t pid, ByteStream output, ByteStream errors);
  std::optional<siginfo_t> exited(std::chrono::milliseconds within) const;

  pid_t pid_;
  bool errors_open_ = true;
  ByteStream output_, errors_;
  std::string unfinished_, last_line_;
};

// Opens the FIFO for reading. Errors: the path does not exist, or it is not a FIFO.
Result<ByteStream> open_fifo(const std::string& path);
// Returns true if bytes have arrived or the writer has closed the FIFO. Do not read a FIFO before a
// writer has opened it: read() would report its end.
bool bytes_or_end_pending(const ByteStream& stream, std::chrono::milliseconds timeout);

}  // namespace mdof::drivers
