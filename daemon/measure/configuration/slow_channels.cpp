#include "daemon/measure/configuration/slow_channels.h"

#include "schema/base/number/number_text.h"

namespace mdof::daemon {

algo::AlignOptions with_intervals(algo::AlignOptions align,
                                  const std::vector<drivers::DeviceInfo>& devices) {
  for (const drivers::DeviceInfo& device : devices) {
    if (!(device.rate_hz > 0)) continue;
    for (const Channel& channel : device.channels) {
      algo::AlignOptions with = align;
      with.interval_s[channel.id] = 1 / device.rate_hz;
      if (with.gap_s(channel.id) > align.gap_s(channel.id)) align = std::move(with);
    }
  }
  return align;
}

Status check_rate(const drivers::DeviceInfo& device, const algo::AlignOptions& align,
                  bool gap_given) {
  if (!(device.rate_hz > 0)) return {};
  const double interval_s = 1 / device.rate_hz;
  const std::string who = "device \"" + device.name + "\": ";
  if (gap_given && align.max_gap_s < interval_s)
    return bad_input(
        who + "max_gap_s = " + plain_number(align.max_gap_s) +
        " s is shorter than the interval between samples (" + plain_number(interval_s) +
        " s), so all values of the device would be missing; sample faster, or remove max_gap_s "
        "from [measure]. Without this key, mdofd calculates the longest gap from the sampling "
        "rate");
  if (align.lag_bound_s < 2 * interval_s)
    return bad_input(who + "lag_bound_s = " + plain_number(align.lag_bound_s) +
                     " s is shorter than two intervals between samples (" +
                     plain_number(2 * interval_s) +
                     " s), so the readings of this device would count as missing; set lag_bound_s "
                     "in [measure] to " +
                     plain_number(2 * interval_s) + " or more, or sample faster");
  return {};
}

}  // namespace mdof::daemon
