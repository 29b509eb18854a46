// Detects whether an open file was deleted or replaced. Writes to such a file succeed, but are lost
// for later readers of its name.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>

namespace mdof::store {

class FileWatch {
 public:
  // Records the present state of the file. The file may only grow.
  explicit FileWatch(std::filesystem::path file);
  // "FILE was deleted ..."; empty: the file is the same and not shorter than before.
  std::string fault();

 private:
  std::filesystem::path file_;
  dev_t device_ = 0;
  ino_t inode_ = 0;
  off_t size_ = 0;
};

}  // namespace mdof::store
