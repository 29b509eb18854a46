#include "daemon/methods/files/client_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <optional>

#include "schema/base/database/files.h"

namespace mdof::daemon {
namespace {

using rpc::Descriptor;

bool is_member(const FileUser& user, gid_t group) {
  const auto& further = user.further_groups;
  return user.gid == group || std::find(further.begin(), further.end(), group) != further.end();
}

// Whether the user has the permission to read the file. mdofd must not read other files for the
// user. Exception: all users of the socket may read a file of the group of mdofd if this group may
// read the file.
bool may_read(const FileUser& user, const struct stat& file) {
  if (user.uid == 0 || user.uid == ::geteuid()) return true;
  if (user.uid == file.st_uid) return (file.st_mode & S_IRUSR) != 0;
  if (is_member(user, file.st_gid) || file.st_gid == ::getegid())
    return (file.st_mode & S_IRGRP) != 0;
  return (file.st_mode & S_IROTH) != 0;
}

// Whether the path causes the error. Such an error is bad_input (a mistake of the caller), as when
// the command line opens a file.
bool is_path_error(int why) {
  return why == ENOENT || why == ENOTDIR || why == EACCES || why == ELOOP || why == ENAMETOOLONG;
}

tl::unexpected<Error> cannot_open(const std::string& path, int why) {
  return fail(is_path_error(why) ? ErrorCode::bad_input : ErrorCode::io,
              path + ": " + rpc::system_error_text(why) +
                  "; mdofd reads this file, so put the file in a folder that the user of mdofd can "
                  "read");
}

Status check_file(const FileUser& user, const std::string& path, int place) {
  struct stat file {};
  if (::fstat(place, &file) != 0) return cannot_open(path, errno);
  if (S_ISLNK(file.st_mode))
    return bad_input(path + ": this path is a link; give the path of the file itself");
  if (!S_ISREG(file.st_mode))
    return bad_input(path + ": this path is not a regular file; give the path of a file");
  if (sqlite::is_open_for_writing(file))
    return fail(ErrorCode::conflict, path +
                                         ": mdofd is writing this file (its database, or a "
                                         "recording under way); replay a recording that has ended");
  if (may_read(user, file)) return {};
  return bad_input(path + ": you have no permission to read this file; check its owner and mode");
}

// Opens the path with O_PATH first. Such a descriptor reads nothing, does not block and does not
// affect locks on the file. If a normal descriptor of a file is closed, the locks of mdofd on this
// file are released. After the check, the same file is opened for reading, even if the path refers
// to another file now.
Result<Descriptor> open_checked(const FileUser& user, const std::string& path) {
  const Descriptor place(::open(path.c_str(), O_PATH | O_NOFOLLOW | O_CLOEXEC));
  if (place.get() < 0) return cannot_open(path, errno);
  MDOF_CHECK(check_file(user, path, place.get()));
  const std::string name = "/proc/self/fd/" + std::to_string(place.get());
  Descriptor file(::open(name.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
  if (file.get() < 0) return cannot_open(path, errno);
  return file;
}

bool exists(const std::string& path) {
  return ::faccessat(AT_FDCWD, path.c_str(), F_OK, AT_SYMLINK_NOFOLLOW) == 0;
}

}  // namespace

Result<ClientFile> open_for(const FileUser& user, const std::string& path) {
  if (!path.starts_with('/'))
    return fail(ErrorCode::usage, "path \"" + path + "\" must be absolute (begin with /)");
  ClientFile opened;
  MDOF_TRY(opened.file, open_checked(user, path));
  if (const std::string wal = path + "-wal"; exists(wal)) {
    MDOF_TRY(opened.wal, open_checked(user, wal));
  }
  return opened;
}

}  // namespace mdof::daemon
