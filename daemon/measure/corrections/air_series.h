// Ambient conditions during a run, from the columns temperature_C, pressure_kPa and
// humidity_percent of a log or the channels with these names.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "schema/rig/effects/physics.h"
#include "schema/sample.h"

namespace mdof::daemon {

// Thread-bound. A value that the rig declares replaces the column.
class AirSeries {
 public:
  explicit AirSeries(const DeclaredAir& declared) : declared_(declared) {}

  // `raw`: as the device gives it. Cells without a value are skipped.
  void push(const SampleBlock& raw);
  // Linear between the means of each second; constant before the first and after the last mean.
  // Returns nullopt if a quantity was neither declared nor read.
  std::optional<Air> at(std::int64_t time_ns) const;

 private:
  struct Second {
    std::int64_t index = 0;
    double sum = 0, time_sum_s = 0;  // time since the beginning of the series
    double n = 0;
  };
  void add(std::size_t quantity, std::int64_t time_ns, double value);
  double interpolated(const std::vector<Second>& seconds, double time_s) const;

  DeclaredAir declared_;
  std::optional<std::int64_t> begin_ns_;
  std::array<std::vector<Second>, kAirQuantities> read_;
};

// Whether the channel contains this quantity.
bool has_air_quantity(const Channel& channel, std::size_t quantity);

}  // namespace mdof::daemon
