// A folder for the files of a fuzzer. It is in memory if the machine has a memory file system,
// because a fuzzer writes a file for each input, and writing on a disk takes some milliseconds.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

namespace mdof {

class FuzzFolder {
 public:
  FuzzFolder() {
    const std::filesystem::path memory = "/dev/shm";
    std::error_code ec;
    std::string name =
        ((std::filesystem::is_directory(memory, ec) ? memory
                                                    : std::filesystem::temp_directory_path()) /
         "mdof_fuzz_XXXXXX")
            .string();
    if (!::mkdtemp(name.data())) std::abort();
    path_ = name;
  }
  ~FuzzFolder() {
    std::error_code ec;
    std::filesystem::remove_all(path_, ec);
  }
  FuzzFolder(const FuzzFolder&) = delete;
  FuzzFolder& operator=(const FuzzFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace mdof
