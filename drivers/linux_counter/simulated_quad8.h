// A channel of a 104-QUAD-8 as it looks in sysfs, with an encoder at it that has a reference mark.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "drivers/sysfs/simulated_tree.h"

namespace mdof::drivers {

// sysfs_root/bus/counter/devices/counter0 with count0: what its driver in the kernel has, after the
// udev rule that drivers/README.md gives.
class SimulatedQuad8 {
 public:
  // The mark is at `mark` counts from where the counter was switched on.
  static Result<SimulatedQuad8> make(const std::filesystem::path& sysfs_root, std::int64_t mark);

  // The axis goes to `position`, in counts from where the counter was switched on.
  Status move_to(std::int64_t position);
  // The counter begins at 0 where the axis stands.
  Status lose_power();
  const SimulatedTree& tree() const { return tree_; }

 private:
  SimulatedQuad8(SimulatedTree tree, std::string path, std::int64_t mark)
      : tree_(std::move(tree)), path_(std::move(path)), mark_(mark) {}
  Result<std::int64_t> value(const std::string& file) const;
  Status show() const;

  SimulatedTree tree_;
  std::string path_;  // of count0
  std::int64_t mark_, position_ = 0;
  std::int64_t zero_ = 0;  // position at which the count is 0
};

}  // namespace mdof::drivers
