// Starts a separate mdofd with simulated axes in a folder.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>

#include "schema/base/result.h"

namespace mdof::tools {

// Thread-bound. The destructor sends SIGTERM and waits until mdofd has ended.
class DemoDaemon {
 public:
  // Writes the example configuration into `folder` and starts `program` (mdofd) with it. mdofd
  // provides the web page at the address `http` ("127.0.0.1:0": any free port), and writes its
  // messages to mdofd.log in `folder`. The function returns when mdofd answers. Errors (io): the
  // files cannot be written; mdofd cannot be started; mdofd ends at once (the message contains its
  // last message).
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

  pid_t pid_;  // 0: mdofd has ended
  std::string socket_;
};

// Returns the path of mdofd: `asked` if it is not empty, otherwise mdofd in the folder of this
// program, otherwise mdofd on PATH.
Result<std::filesystem::path> find_mdofd(const std::string& asked);

}  // namespace mdof::tools
