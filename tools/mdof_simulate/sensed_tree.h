// Devices that Linux shows as files: a folder of them, rewritten as the machine moves.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>

#include "drivers/simulated_device.h"
#include "drivers/sysfs/simulated_tree.h"
#include "schema/base/result.h"

namespace mdof::simulate {

// No ports: only turn() does anything. Thread-bound.
class SensedFiles : public drivers::SimulatedDevice {
 public:
  std::vector<Port> ports() const override { return {}; }
  void opened(std::size_t, int, std::int64_t) override {}
  void closed(std::size_t, int) override {}
  std::string exchange(std::size_t, int, std::string_view, std::int64_t) override { return ""; }
  bool hangs_up(std::size_t, int) override { return false; }

 protected:
  SensedFiles(drivers::SimulatedTree tree, drivers::Senses senses)
      : tree_(std::move(tree)), senses_(std::move(senses)) {}
  drivers::SimulatedTree tree_;
  drivers::Senses senses_;
};

// counter0 of `sysfs_root`, 32 bits; input 0: counts.
class SensedCounter final : public SensedFiles {
 public:
  static Result<std::unique_ptr<drivers::SimulatedDevice>> make(
      const std::filesystem::path& sysfs_root, drivers::Senses senses);
  void turn(std::int64_t now_ns) override;

 private:
  using SensedFiles::SensedFiles;
};

// iio:device0 of `sysfs_root`, an AD7746; inputs 0 and 1: gaps in µm before guarded electrodes.
class SensedConverter final : public SensedFiles {
 public:
  static Result<std::unique_ptr<drivers::SimulatedDevice>> make(
      const std::filesystem::path& sysfs_root, double area_mm2, std::size_t inputs,
      drivers::Senses senses);
  void turn(std::int64_t now_ns) override;

 private:
  SensedConverter(drivers::SimulatedTree tree, drivers::Senses senses, double area_mm2,
                  std::size_t inputs)
      : SensedFiles(std::move(tree), std::move(senses)), area_mm2_(area_mm2), inputs_(inputs) {}
  double area_mm2_;
  std::size_t inputs_;
};

}  // namespace mdof::simulate
