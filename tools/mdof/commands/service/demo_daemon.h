// An mdofd of mdof's own, with simulated axes, in a folder.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>

#include "schema/base/result.h"

namespace mdof::tools {

// Thread-bound. The destructor asks it to end (SIGTERM), and waits until it has.
class DemoDaemon {
 public:
  // Writes the example configuration into `folder` and starts `program` on it; the page is served
  // at `http` ("127.0.0.1:0": any port). Its words go to mdofd.log there. Gives it once it answers.
  // Errors (io): files cannot be written, it cannot be started, or ends at once (its last words).
  static Result<DemoDaemon> start(const std::filesystem::path& program,
                                  const std::filesystem::path& folder, const std::string& http);
  ~DemoDaemon();
  DemoDaemon(DemoDaemon&& other) noexcept;
  DemoDaemon(const DemoDaemon&) = delete;
  DemoDaemon& operator=(const DemoDaemon&) = delete;

  const std::string& socket() const { return socket_; }
  bool has_ended();

 private:
  DemoDaemon(pid_t pid, std::string socket) : pid_(pid), socket_(std::move(socket)) {}

  pid_t pid_;  // 0: it has ended
  std::string socket_;
};

// `asked`, or mdofd beside this program, else on PATH.
Result<std::filesystem::path> find_mdofd(const std::string& asked);

}  // namespace mdof::tools
