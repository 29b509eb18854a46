// A folder that looks like a device in sysfs: files that are rewritten in place while a driver
// reads them, and reads that fail as the kernel's do.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "drivers/sysfs/attribute.h"

namespace mdof::drivers {

class SimulatedTree {
 public:
  explicit SimulatedTree(std::filesystem::path folder);

  // Makes the file, or replaces its text in one write, as a reader sees it.
  Status set(const std::string& file, const std::string& text) const;
  void remove(const std::string& file) const;

  // For a driver's reads. The next `count` of them (-1: all) fail with `error`. Any thread.
  SysfsRead reads() const;
  void fail_reads(int error, int count = -1);

 private:
  struct Faults {
    std::atomic<int> error{0}, left{0};
  };
  std::filesystem::path folder_;
  std::shared_ptr<Faults> faults_ = std::make_shared<Faults>();
};

// sysfs_root/bus/counter/devices/counter0 with count0, at 0: quadrature x4, `ceiling`.
Result<SimulatedTree> make_counter_tree(const std::filesystem::path& sysfs_root,
                                        std::uint64_t ceiling);
// sysfs_root/bus/iio/devices/iio:device0, an AD7746 with nothing at its inputs, 9 Hz.
Result<SimulatedTree> make_ad7746_tree(const std::filesystem::path& sysfs_root);

}  // namespace mdof::drivers
