// A simulated counter of the Linux counter subsystem, as files of sysfs.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include "drivers/simulated_device.h"
#include "drivers/simulated_wiring.h"
#include "drivers/sysfs/simulated_tree.h"
#include "schema/base/result.h"

namespace mdof::drivers {

// Makes the folder sysfs_root/bus/counter/devices/counter0 with count0: count 0, function
// quadrature x4, `ceiling`.
Result<SimulatedTree> make_counter_tree(const std::filesystem::path& sysfs_root,
                                        std::uint64_t ceiling);

// Senses: input 0 is the count. turn() writes the count to its file.
class SimulatedLinuxCounter final : public SimulatedDevice {
 public:
  struct Options {
    std::filesystem::path sysfs_root;
  };
  // Error: the folder cannot be written.
  static Result<std::unique_ptr<SimulatedLinuxCounter>> make(Senses senses, const Options& options);
  void turn(std::int64_t now_ns) override;

 private:
  SimulatedLinuxCounter(Senses senses, SimulatedTree tree)
      : senses_(std::move(senses)), tree_(std::move(tree)) {}
  Senses senses_;
  SimulatedTree tree_;
};

// Makes the twin from a plan of mdof-simulate. It counts the given channel; default: the encoder.
Result<std::unique_ptr<SimulatedDevice>> make_simulated_linux_counter(SimulatedWiring& wiring);

}  // namespace mdof::drivers
