#include "daemon/measure/points/run_temperature.h"

#include <algorithm>
#include <cmath>

#include "schema/rig/effects/physics.h"

namespace mdof::daemon {

void RunTemperature::push(const SampleBlock& raw) {
  const Channel wanted{"temperature", Unit::deg_c};
  const auto found = std::find(raw.channels.begin(), raw.channels.end(), wanted);
  if (found == raw.channels.end()) return;
  for (const double read_C : raw.value[static_cast<std::size_t>(found - raw.channels.begin())]) {
    if (!std::isfinite(read_C)) continue;
    const AirQuantity& of = air_quantities()[0];
    if (read_C < of.least || read_C > of.most) {  // the sensor failed, or the unit is wrong
      if (left_out_++ == 0) first_left_out_C_ = read_C;
      continue;
    }
    if (n_++ == 0) sum_ = {0, read_C, read_C};
    sum_.mean_C += read_C;
    sum_.min_C = std::min(sum_.min_C, read_C);
    sum_.max_C = std::max(sum_.max_C, read_C);
  }
}

std::optional<Temperature> RunTemperature::of_run() const {
  if (n_ == 0) return std::nullopt;
  return Temperature{sum_.mean_C / static_cast<double>(n_), sum_.min_C, sum_.max_C};
}

std::optional<Notice> RunTemperature::left_out() const {
  if (left_out_ == 0) return std::nullopt;
  const AirQuantity& of = air_quantities()[0];
  return notice(NoticeCode::temperature_left_out, "",
                {{"readings", static_cast<double>(left_out_)},
                 {"all", static_cast<double>(left_out_ + n_)},
                 {"first_C", first_left_out_C_},
                 {"least_C", of.least},
                 {"most_C", of.most}});
}

}  // namespace mdof::daemon
