// Opens a file that a client names. All such files are opened here: once, with the permissions
// checked on the open file, and then read only through its descriptor.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

#include "daemon/rpc/net/socket.h"
#include "schema/base/result.h"

namespace mdof::daemon {

// The requesting user: uid and groups as the kernel reports them.
struct FileUser {
  uid_t uid = 0;
  gid_t gid = 0;
  std::vector<gid_t> further_groups = {};
};

struct ClientFile {
  rpc::Descriptor file;
  rpc::Descriptor wal;  // the WAL file of a recording whose changes are not yet in the file; -1:
                        // none
};

// Opens the file for reading. A terminal does not become the controlling terminal of mdofd; a pipe
// without writer does not block. Errors: a path that is not absolute or is a link; no regular file;
// a file that the user or mdofd may not read. May block on the file system, so do not call it on
// the event loop.
Result<ClientFile> open_for(const FileUser& user, const std::string& path);

}  // namespace mdof::daemon
