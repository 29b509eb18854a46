#include "drivers/linux_iio/simulated_linux_iio.h"

#include <cmath>
#include <string>
#include <utility>

#include "drivers/linux_iio/protocol.h"

namespace mdof::drivers {
namespace {

constexpr double kEps0_um_pF_per_mm2 = 8.8541878128;

}  // namespace

Result<SimulatedTree> make_ad7746_tree(const std::filesystem::path& sysfs_root) {
  return SimulatedTree::make(
      sysfs_root / "bus/iio/devices/iio:device0",
      {{"name", "ad7746"},
       {"in_capacitance0_raw", "0"},
       {"in_capacitance0_offset", "0"},
       {"in_capacitance1_raw", "0"},
       {"in_capacitance1_offset", "0"},
       {"in_capacitance0-capacitance2_raw", "0"},
       {"in_capacitance0-capacitance2_zeropoint", "0"},
       {"in_capacitance1-capacitance3_raw", "0"},
       {"in_capacitance1-capacitance3_zeropoint", "0"},
       {"in_capacitance_scale", "0.000000488"},
       {"in_capacitance_sampling_frequency", "9"},
       {"in_capacitance_sampling_frequency_available", "91 84 50 26 16 13 11 9"}});
}

Result<std::unique_ptr<SimulatedLinuxIio>> SimulatedLinuxIio::make(Senses senses,
                                                                   const Options& options) {
  MDOF_TRY(auto tree, make_ad7746_tree(options.sysfs_root));
  return std::unique_ptr<SimulatedLinuxIio>(
      new SimulatedLinuxIio(std::move(senses), std::move(tree), options));
}

void SimulatedLinuxIio::turn(std::int64_t now_ns) {
  for (std::size_t i = 0; i < options_.inputs; ++i) {
    const double pF = kEps0_um_pF_per_mm2 * options_.area_mm2 / senses_(i, now_ns);
    const auto raw = std::llround(pF / kAd7746_pF_per_count);
    // Errors are ignored, because a removed folder simulates a disconnected device.
    (void)tree_.set("in_capacitance" + std::to_string(i) + "_raw", std::to_string(raw));
  }
}

Result<std::unique_ptr<SimulatedDevice>> make_simulated_linux_iio(SimulatedWiring& wiring) {
  SimulatedLinuxIio::Options options;
  options.sysfs_root = wiring.folder() / wiring.table().string("sysfs_root");
  options.area_mm2 = wiring.table().number("area_mm2");
  options.inputs = wiring.inputs().size();
  std::vector<SensedInput> sensed;
  for (const std::string& input : wiring.inputs()) sensed.push_back(wiring.um(input));
  return SimulatedLinuxIio::make(wiring.senses(std::move(sensed)), options);
}

}  // namespace mdof::drivers
