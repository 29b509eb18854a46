// Detects that an open file was deleted or replaced. Writes to such a file succeed, but a program
// that opens the path later does not find the data.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>

namespace mdof::store {

class FileWatch {
 public:
  // Notes the current state of the file. Later the file must not become shorter.
  explicit FileWatch(std::filesystem::path file);
  // Text of the fault, "FILE was deleted ...". Empty: the file is the same file and is not shorter
  // than before.
  std::string fault();

 private:
  std::filesystem::path file_;
  dev_t device_ = 0;
  ino_t inode_ = 0;
  off_t size_ = 0;
};

}  // namespace mdof::store
