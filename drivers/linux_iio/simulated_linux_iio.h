// A simulated AD7746 of the Linux IIO subsystem, as files of sysfs.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>

#include "drivers/simulated_device.h"
#include "drivers/simulated_wiring.h"
#include "drivers/sysfs/simulated_tree.h"
#include "schema/base/result.h"

namespace mdof::drivers {

// Makes the folder sysfs_root/bus/iio/devices/iio:device0: an AD7746 without probes, sampling rate
// 9 Hz.
Result<SimulatedTree> make_ad7746_tree(const std::filesystem::path& sysfs_root);

// Senses: inputs 0 and 1 are gaps in µm in front of guarded electrodes. turn() writes the
// capacitances to the files.
class SimulatedLinuxIio final : public SimulatedDevice {
 public:
  struct Options {
    std::filesystem::path sysfs_root;
    double area_mm2 = 0;     // area of each electrode
    std::size_t inputs = 0;  // number of inputs with a probe
  };
  // Error: the folder cannot be written.
  static Result<std::unique_ptr<SimulatedLinuxIio>> make(Senses senses, const Options& options);
  void turn(std::int64_t now_ns) override;

 private:
  SimulatedLinuxIio(Senses senses, SimulatedTree tree, Options options)
      : senses_(std::move(senses)), tree_(std::move(tree)), options_(std::move(options)) {}
  Senses senses_;
  SimulatedTree tree_;
  Options options_;
};

// Makes the twin from a plan of mdof-simulate. The probes have gaps in µm and electrodes of
// area_mm2.
Result<std::unique_ptr<SimulatedDevice>> make_simulated_linux_iio(SimulatedWiring& wiring);

}  // namespace mdof::drivers
