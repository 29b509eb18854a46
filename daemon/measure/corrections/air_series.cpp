#include "daemon/measure/corrections/air_series.h"

#include <algorithm>
#include <cmath>

#include "schema/units.h"

namespace mdof::daemon {

// The column temperature_C is read as the channel "temperature" in °C. The enumeration Unit does
// not contain the units of the other quantities, so the channels of these quantities have the names
// of the columns.
bool has_air_quantity(const Channel& channel, std::size_t quantity) {
  const AirQuantity& of = air_quantities()[quantity];
  if (channel.unit == Unit::deg_c) return quantity == 0 && channel.id == of.name;
  return channel.unit == Unit::other && channel.id == of.key;
}

void AirSeries::push(const SampleBlock& raw) {
  for (std::size_t q = 0; q < kAirQuantities; ++q) {
    if (declared_.run[q]) continue;
    for (std::size_t c = 0; c < raw.channels.size(); ++c) {
      if (!has_air_quantity(raw.channels[c], q)) continue;
      for (std::size_t i = 0; i < raw.scans(); ++i) add(q, raw.time_ns[i], raw.value[c][i]);
    }
  }
}

void AirSeries::add(std::size_t quantity, std::int64_t time_ns, double value) {
  const AirQuantity& of = air_quantities()[quantity];
  // Ignores NaN and values of a sensor that failed.
  if (!(value >= of.least && value <= of.most)) return;
  if (!begin_ns_) begin_ns_ = time_ns;
  const std::int64_t since_ns = time_ns - *begin_ns_, index = since_ns / kNsPerS;
  auto& seconds = read_[quantity];
  if (seconds.empty() || seconds.back().index != index) seconds.push_back({index});
  seconds.back().sum += value;
  seconds.back().time_sum_s += ns_to_s(since_ns);
  seconds.back().n += 1;
}

double AirSeries::interpolated(const std::vector<Second>& seconds, double time_s) const {
  const auto time_of = [](const Second& s) { return s.time_sum_s / s.n; };
  const auto mean_of = [](const Second& s) { return s.sum / s.n; };
  const auto after =
      std::partition_point(seconds.begin(), seconds.end(),
                           [&](const Second& second) { return !(time_of(second) > time_s); });
  if (after == seconds.begin()) return mean_of(seconds.front());
  if (after == seconds.end()) return mean_of(seconds.back());
  const double from_s = time_of(*(after - 1)),
               share = (time_s - from_s) / (time_of(*after) - from_s);
  return mean_of(*(after - 1)) + share * (mean_of(*after) - mean_of(*(after - 1)));
}

std::optional<Air> AirSeries::at(std::int64_t time_ns) const {
  Air air{};
  for (std::size_t q = 0; q < kAirQuantities; ++q) {
    if (!declared_.run[q] && read_[q].empty()) return std::nullopt;
    air[q] = declared_.run[q]
                 ? *declared_.run[q]
                 : interpolated(read_[q], ns_to_s(time_ns - begin_ns_.value_or(time_ns)));
  }
  return air;
}

}  // namespace mdof::daemon
