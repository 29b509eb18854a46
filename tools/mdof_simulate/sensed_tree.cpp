#include "tools/mdof_simulate/sensed_tree.h"

#include <cmath>

#include "drivers/linux_iio/protocol.h"

namespace mdof::simulate {
namespace {

constexpr double kEps0_um_pF_per_mm2 = 8.8541878128;

}  // namespace

Result<std::unique_ptr<drivers::SimulatedDevice>> SensedCounter::make(
    const std::filesystem::path& sysfs_root, drivers::Senses senses) {
  MDOF_TRY(auto tree, drivers::make_counter_tree(sysfs_root, UINT32_MAX));
  return std::unique_ptr<drivers::SimulatedDevice>(
      new SensedCounter(std::move(tree), std::move(senses)));
}

void SensedCounter::turn(std::int64_t now_ns) {
  const auto count = std::llround(senses_(0, now_ns));
  // A folder that has been removed is a device that has gone.
  (void)tree_.set("count0/count", std::to_string(static_cast<std::uint32_t>(count)));
}

Result<std::unique_ptr<drivers::SimulatedDevice>> SensedConverter::make(
    const std::filesystem::path& sysfs_root, double area_mm2, std::size_t inputs,
    drivers::Senses senses) {
  MDOF_TRY(auto tree, drivers::make_ad7746_tree(sysfs_root));
  return std::unique_ptr<drivers::SimulatedDevice>(
      new SensedConverter(std::move(tree), std::move(senses), area_mm2, inputs));
}

void SensedConverter::turn(std::int64_t now_ns) {
  for (std::size_t i = 0; i < inputs_; ++i) {
    const double pF = kEps0_um_pF_per_mm2 * area_mm2_ / senses_(i, now_ns);
    const auto raw = std::llround(pF / drivers::kAd7746_pF_per_count);
    (void)tree_.set("in_capacitance" + std::to_string(i) + "_raw", std::to_string(raw));
  }
}

}  // namespace mdof::simulate
