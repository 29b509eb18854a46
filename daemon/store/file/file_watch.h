// Whether a file that is open is still the one that its name means: one that was deleted or
// replaced takes every write and keeps none for those who come after.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>

namespace mdof::store {

class FileWatch {
 public:
  // As it is now. It grows, and never becomes shorter.
  explicit FileWatch(std::filesystem::path file);
  // "FILE was deleted ..."; empty: it is there, the same, and not shorter than it was.
  std::string fault();

 private:
  std::filesystem::path file_;
  dev_t device_ = 0;
  ino_t inode_ = 0;
  off_t size_ = 0;
};

}  // namespace mdof::store
