// A folder that simulates a device in sysfs: files are rewritten in place while a driver reads
// them, and reads fail with the errors of the kernel.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <memory>
#include <string>

#include "drivers/sysfs/attribute.h"

namespace mdof::drivers {

class SimulatedTree {
 public:
  struct File {
    const char* name;
    std::string text;
  };
  explicit SimulatedTree(std::filesystem::path folder);
  // Makes the folder with these files.
  static Result<SimulatedTree> make(const std::filesystem::path& folder,
                                    std::initializer_list<File> files);

  // Makes the file or replaces its text in one write, so that a reader sees either text.
  Status set(const std::string& file, const std::string& text) const;
  void remove(const std::string& file) const;

  // Reads for a driver. fail_reads() lets the next `count` of them (-1: all) fail with `error`. Any
  // thread.
  SysfsRead reads() const;
  void fail_reads(int error, int count = -1);

 private:
  struct Faults {
    std::atomic<int> error{0}, left{0};
  };
  std::filesystem::path folder_;
  std::shared_ptr<Faults> faults_ = std::make_shared<Faults>();
};

}  // namespace mdof::drivers
