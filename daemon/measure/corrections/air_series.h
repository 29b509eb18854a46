// Ambient conditions during a run, read from the columns temperature_C, pressure_kPa and
// humidity_percent of a log, or from the channels of these quantities.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "schema/rig/effects/physics.h"
#include "schema/sample.h"

namespace mdof::daemon {

// Thread-bound. If the rig declares a value, that value is used and the column is ignored.
class AirSeries {
 public:
  explicit AirSeries(const DeclaredAir& declared) : declared_(declared) {}

  // `raw`: samples before calibration. NaN and values out of the range of the quantity are ignored.
  void push(const SampleBlock& raw);
  // Averages the values of each second and interpolates linearly between these means. Before the
  // first mean and after the last mean, the value is constant. Returns nullopt if a quantity was
  // neither declared nor read.
  std::optional<Air> at(std::int64_t time_ns) const;

 private:
  struct Second {
    std::int64_t index = 0;
    double sum = 0, time_sum_s = 0;  // sums of the values and of their times since the first value
    double n = 0;
  };
  void add(std::size_t quantity, std::int64_t time_ns, double value);
  double interpolated(const std::vector<Second>& seconds, double time_s) const;

  DeclaredAir declared_;
  std::optional<std::int64_t> begin_ns_;
  std::array<std::vector<Second>, kAirQuantities> read_;
};

// Whether the channel measures this quantity (index in air_quantities()).
bool has_air_quantity(const Channel& channel, std::size_t quantity);

}  // namespace mdof::daemon
