// A simulated channel of a 104-QUAD-8, as files of sysfs. Its encoder has a reference mark.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "drivers/sysfs/simulated_tree.h"

namespace mdof::drivers {

// The folder sysfs_root/bus/counter/devices/counter0 with count0. It contains the files of the
// kernel's driver, with the permissions that the udev rule sets (drivers/README.md).
class SimulatedQuad8 {
 public:
  // `mark`: position of the mark, in counts from the position at which the counter was switched on.
  static Result<SimulatedQuad8> make(const std::filesystem::path& sysfs_root, std::int64_t mark);

  // Moves the axis to `position`, in counts from the position at which the counter was switched on.
  Status move_to(std::int64_t position);
  // The counter restarts: its count is 0 at the present position.
  Status lose_power();
  const SimulatedTree& tree() const { return tree_; }

 private:
  SimulatedQuad8(SimulatedTree tree, std::string path, std::int64_t mark)
      : tree_(std::move(tree)), path_(std::move(path)), mark_(mark) {}
  Result<std::int64_t> value(const std::string& file) const;
  Status show() const;

  SimulatedTree tree_;
  std::string path_;  // folder of count0
  std::int64_t mark_, position_ = 0;
  std::int64_t zero_ = 0;  // position at which the count is 0
};

}  // namespace mdof::drivers
