#include "daemon/measure/delays.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "schema/base/number/number_text.h"
#include "schema/sample.h"

namespace mdof::daemon {
namespace {

// Ten seconds; a reading with a longer delay is useless for the measurement of an axis.
constexpr double kMost_us = 10e6;
constexpr int kDigits = 9;  // with fewer digits, rounding could make the suggested value too small

double of(const ChannelDelays& delays, const std::string& id) {
  const auto found = delays.find(id);
  return found == delays.end() ? 0 : found->second;
}

double longest_s(const Rig& rig, const ChannelDelays& delays) {
  std::vector<double> all_s;
  for (const Probe& probe : rig.probes) all_s.push_back(of(delays, probe.id));
  return all_s.empty() ? 0 : *std::max_element(all_s.begin(), all_s.end());
}

// Returns "" if the rig has a channel with this id, otherwise the text of the error.
std::string delay_problem(const std::string& id, const Rig& rig) {
  std::vector<std::string> known = {kEncoderChannel};
  for (const Probe& probe : rig.probes) known.push_back(probe.id);
  if (std::find(known.begin(), known.end(), id) != known.end()) return "";
  const std::string near = nearest_candidate(id, known);
  return "\"" + id + "\" is neither a probe of " + rig.source + " nor \"" + kEncoderChannel + "\"" +
         (near.empty() ? "" : "; did you mean \"" + near + "\"?");
}

std::string too_long(double delay_s, double settle_s) {
  return "a delay of " + plain_number(delay_s, kDigits) +
         " s is longer than settle_s = " + plain_number(settle_s, kDigits) +
         " s, so the averages of a stop would include readings from before the axis stopped";
}

}  // namespace

void read_delays(TomlTable& device, const Rig& rig, double settle_s, ChannelDelays& delays) {
  for (TomlTable& channel : device.tables("channel")) {
    const std::string id = channel.string("id", "");
    const double delay_us = channel.number("delay_us", 0);
    if (!channel.has("delay_us")) continue;
    if (const std::string problem = delay_problem(id, rig); !problem.empty())
      channel.reject("id", problem);
    if (!(delay_us >= 0 && delay_us <= kMost_us)) {
      channel.reject("delay_us", "must be from 0 to " + plain_number(kMost_us, kDigits) +
                                     "; set 0 for the channel with the shortest delay. For each "
                                     "other channel, set its delay relative to that channel");
    } else if (delay_us / 1e6 > settle_s) {
      channel.reject("delay_us", too_long(delay_us / 1e6, settle_s), Remedy::raise_settle,
                     plain_number(delay_us / 1e6, kDigits));
    }
    delays[id] = delay_us / 1e6;
  }
}

PipelineOptions with_delays(PipelineOptions options, const Rig& rig, const ChannelDelays& delays) {
  const double encoder_s = rig.encoder_delay_s + of(delays, kEncoderChannel);
  bool differ = false;
  for (const Probe& probe : rig.probes) {
    const double delay_s = probe.delay_s + of(delays, probe.id);
    differ = differ || delay_s != encoder_s;
    options.align.delay_s[probe.id] = delay_s - encoder_s;
    options.dwell.leave_s = std::max(options.dwell.leave_s, delay_s);
  }
  if (!differ) options.align.delay_s.clear();
  return options;
}

PipelineOptions with_delays_of(const Rig& rig, const Rig& recorded, PipelineOptions options) {
  auto& relative_s = options.align.delay_s;
  const double encoder_more_s = rig.encoder_delay_s - recorded.encoder_delay_s;
  const double encoder_s = options.dwell.leave_s - longest_s(recorded, relative_s) + encoder_more_s;
  bool differ = false, changed = false;
  for (const Probe& probe : rig.probes) {
    const auto before = recorded.probe_index(probe.id);
    const double more_s =
        probe.delay_s - (before ? recorded.probes[*before].delay_s : 0) - encoder_more_s;
    changed = changed || more_s != 0;
    relative_s[probe.id] += more_s;
    differ = differ || relative_s[probe.id] != 0;
  }
  if (changed) options.dwell.leave_s = std::max(0.0, encoder_s + longest_s(rig, relative_s));
  if (!differ) relative_s.clear();
  return options;
}

Status check_settling(const PipelineOptions& options) {
  if (options.dwell.leave_s <= options.dwell.settle_s) return {};
  return bad_input(too_long(options.dwell.leave_s, options.dwell.settle_s), Remedy::raise_settle,
                   plain_number(options.dwell.leave_s, kDigits));
}

}  // namespace mdof::daemon
