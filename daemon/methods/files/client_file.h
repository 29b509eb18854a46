// A file that a client names. This is the one place where mdofd opens one: it is opened once, its
// rights are those of the file that is open, and it is read through its descriptor alone.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

#include "daemon/rpc/net/socket.h"
#include "schema/base/result.h"

namespace mdof::daemon {

// Who wants it read, by uid and groups as the kernel gives them.
struct FileUser {
  uid_t uid = 0;
  gid_t gid = 0;
  std::vector<gid_t> further_groups = {};
};

struct ClientFile {
  rpc::Descriptor file;
  rpc::Descriptor wal;  // of a recording with changes that are not in the file yet; -1: none
};

// For reading; takes no terminal, waits for no writer of a pipe. Errors: a path that is not
// absolute or is a link, no regular file, one that the user or mdofd may not read. It may wait for
// the file system that the path leads to: not on the event loop.
Result<ClientFile> open_for(const FileUser& user, const std::string& path);

}  // namespace mdof::daemon
