#include "daemon/store/file/file_watch.h"

#include <sys/stat.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace mdof::store {

FileWatch::FileWatch(std::filesystem::path file) : file_(std::move(file)) {
  struct stat now {};
  if (::stat(file_.c_str(), &now) != 0) return;
  device_ = now.st_dev;
  inode_ = now.st_ino;
  size_ = now.st_size;
}

std::string FileWatch::fault() {
  struct stat now {};
  if (::stat(file_.c_str(), &now) != 0)
    return file_.string() +
           (errno == ENOENT ? " was deleted" : ": " + std::string(strerror(errno)));
  if (now.st_dev != device_ || now.st_ino != inode_)
    return file_.string() + " was replaced by another file";
  if (now.st_size < size_) return file_.string() + " was truncated";
  size_ = now.st_size;
  return {};
}

}  // namespace mdof::store
