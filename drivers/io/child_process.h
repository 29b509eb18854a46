// A program started for its standard output; and a FIFO, for programs that start by themselves.
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

// Thread-bound. The destructor ends the program and what it has started in its process group:
// SIGTERM, half a second later SIGKILL.
class ChildProcess {
 public:
  // `command[0]` is looked up in PATH unless it has a '/'; no shell takes part. Runs in `folder`,
  // standard input empty. Error: it cannot be started.
  static Result<std::unique_ptr<ChildProcess>> start(const std::vector<std::string>& command,
                                                     const std::string& folder);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  ByteStream& output() { return output_; }
  // Takes what it has written to its standard error, of which the last line is kept. To be called
  // now and then, or the program stands still once 64 KiB wait.
  void take_errors();
  // How the program ended, once its output has ended: "has exited with status 3; its last line of
  // standard error: ...". Waits for its exit, but not for long.
  std::string how_it_ended();

 private:
  ChildProcess(pid_t pid, ByteStream output, ByteStream errors);
  std::optional<siginfo_t> exited(std::chrono::milliseconds within) const;

  pid_t pid_;
  bool errors_open_ = true;
  ByteStream output_, errors_;
  std::string unfinished_, last_line_;
};

// Opens it for reading. Error: not there, or no FIFO.
Result<ByteStream> open_fifo(const std::string& path);
// True: bytes have come, or the writer has gone. A FIFO that nobody has opened for writing yet must
// not be read: that looks like its end.
bool wait_for_bytes(const ByteStream& stream, std::chrono::milliseconds timeout);

}  // namespace mdof::drivers
