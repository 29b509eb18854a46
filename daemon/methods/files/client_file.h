// Opens the files that clients name. mdofd opens each path only once, checks the permissions of the
// open file, and reads the file only through its descriptor.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

#include "daemon/rpc/net/socket.h"
#include "schema/base/result.h"

namespace mdof::daemon {

// The user that sends the request. The kernel reports uid and groups.
struct FileUser {
  uid_t uid = 0;
  gid_t gid = 0;
  std::vector<gid_t> further_groups = {};
};

struct ClientFile {
  rpc::Descriptor file;
  rpc::Descriptor wal;  // the WAL file of a recording, with changes that are not in the file yet;
                        // -1: no WAL file
};

// Opens the file for reading. A terminal does not become the controlling terminal of mdofd. If the
// path is a pipe without a writer, the function does not block. Errors: the path is not absolute,
// or is a link; the file is not a regular file; mdofd is writing the file; the user or mdofd has no
// permission to read the file. Do not call the function on the event loop, because the file system
// can block it.
Result<ClientFile> open_for(const FileUser& user, const std::string& path);

}  // namespace mdof::daemon
