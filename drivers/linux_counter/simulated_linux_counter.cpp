#include "drivers/linux_counter/simulated_linux_counter.h"

#include <cmath>
#include <string>
#include <utility>

namespace mdof::drivers {

Result<SimulatedTree> make_counter_tree(const std::filesystem::path& sysfs_root,
                                        std::uint64_t ceiling) {
  return SimulatedTree::make(sysfs_root / "bus/counter/devices/counter0",
                             {{"name", "simulated-counter"},
                              {"num_counts", "1"},
                              {"count0/count", "0"},
                              {"count0/function", "quadrature x4"},
                              {"count0/count_mode", "normal"},
                              {"count0/enable", "1"},
                              {"count0/floor", "0"},
                              {"count0/ceiling", std::to_string(ceiling)}});
}

Result<std::unique_ptr<SimulatedLinuxCounter>> SimulatedLinuxCounter::make(Senses senses,
                                                                           const Options& options) {
  MDOF_TRY(auto tree, make_counter_tree(options.sysfs_root, UINT32_MAX));
  return std::unique_ptr<SimulatedLinuxCounter>(
      new SimulatedLinuxCounter(std::move(senses), std::move(tree)));
}

void SimulatedLinuxCounter::turn(std::int64_t now_ns) {
  const auto count = std::llround(senses_(0, now_ns));
  // Errors are ignored, because a removed folder simulates a disconnected device.
  (void)tree_.set("count0/count", std::to_string(static_cast<std::uint32_t>(count)));
}

Result<std::unique_ptr<SimulatedDevice>> make_simulated_linux_counter(SimulatedWiring& wiring) {
  const SimulatedLinuxCounter::Options options{wiring.folder() /
                                               wiring.table().string("sysfs_root")};
  const SensedInput counts = wiring.counts(wiring.first_or_encoder());
  return SimulatedLinuxCounter::make(wiring.senses({counts}), options);
}

}  // namespace mdof::drivers
