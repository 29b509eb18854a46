// A folder that simulates a device in sysfs. Its files can be changed while a driver reads them,
// and reads can fail with the errors of the kernel.
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

  // Makes the file or replaces its text in one write. A reader therefore reads either the old or
  // the new text.
  Status set(const std::string& file, const std::string& text) const;
  void remove(const std::string& file) const;

  // reads() returns the read function for a driver. fail_reads() causes the next `count` reads (-1:
  // all) to fail with `error`. Any thread may call them.
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
