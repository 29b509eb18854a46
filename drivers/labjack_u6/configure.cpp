#include "drivers/labjack_u6/configure.h"

#include <algorithm>
#include <cmath>

#include "drivers/channels.h"
#include "drivers/labjack/input_keys.h"
#include "drivers/labjack_u6/labjack_u6.h"

namespace mdof::drivers {
namespace {

using namespace labjack_u6;

// The device allows two timers on any lines. The driver allows only the pairs that have their own
// terminals.
constexpr int kCounterLines[] = {0, 2};
constexpr double kMostSamples_Hz = 50'000;  // samples of all inputs together
// The firmware handles each edge. The limit is from LabJack's manual of the U3, which counts in the
// same way.
constexpr double kMostCounts_per_s = 30'000;
constexpr int kMostResolution = 8, kMostSettling_us = 2550;

void read_serial(TomlTable& table, Settings& settings) {
  const std::int64_t serial = table.integer("serial", 0);
  if (serial < 0 || serial > UINT32_MAX)
    table.reject("serial",
                 "must be the serial number of a U6, a whole number from 1 to 4294967295");
  if (serial > 0) settings.serial = std::to_string(serial);
}

// Returns the gain for inputs whose channel has no key range_v.
int read_gain(TomlTable& table) {
  const int gain = labjack::range_of(table.number("range_v", 10));
  if (gain < 0) table.reject("range_v", labjack::kRangesText);
  return std::max(gain, 0);
}

void read_converter(TomlTable& table, Settings& settings) {
  const std::int64_t resolution = table.integer("resolution_index", 0);
  if (resolution < 0 || resolution > kMostResolution)
    table.reject("resolution_index", "must be from 0 (the default) to 8");
  settings.resolution_index = static_cast<int>(resolution);
  const double settling_us = table.number("settling_us", 0);
  if (!(settling_us >= 0 && settling_us <= kMostSettling_us))
    return table.reject("settling_us", "must be from 0 (automatic) to 2550, in steps of 10");
  settings.settling_10us = static_cast<int>(std::ceil(settling_us / 10));
}

void read_rate(TomlTable& table, Settings& settings) {
  const std::size_t words = scan_list(settings.inputs).size();
  settings.rate_hz = table.number("rate_hz", settings.rate_hz);
  if (!(settings.rate_hz >= 1 && settings.rate_hz * static_cast<double>(words) <= kMostSamples_Hz))
    table.reject("rate_hz",
                 "must be from 1 to " + std::to_string(static_cast<int>(kMostSamples_Hz) / words) +
                     ": a U6 measures at most 50000 samples/s, and a scan of these inputs has " +
                     std::to_string(words) + " samples (1 for an analogue input, 2 for a counter)");
}

std::vector<std::string> counters() {
  std::vector<std::string> names;
  for (const int line : kCounterLines) names.push_back("FIO" + std::to_string(line));
  return names;
}

Input input_of(const ChannelInput& channel, const labjack::InputKeys& keys,
               const labjack::InputUse& use, int gain) {
  Input input;
  input.channel = {channel.id, use.ain < 0 ? Unit::um : Unit::volt};
  input.ain = use.ain;
  input.differential = use.negative >= 0;
  if (use.ain >= 0) {
    input.gain = keys.range_v > 0 ? std::max(labjack::range_of(keys.range_v), 0) : gain;
    return input;
  }
  input.fio = kCounterLines[use.counter];
  input.um_per_count = channel.um_per_count;
  input.most_counts_per_s = keys.most_counts_per_s > 0 ? keys.most_counts_per_s : kMostCounts_per_s;
  return input;
}

Status read_inputs(TomlTable& table, const DriverContext& context, Settings& settings) {
  auto& inputs = settings.inputs;
  const int gain = read_gain(table);
  std::vector<labjack::InputKeys> keys;
  std::vector<labjack::InputUse> uses;
  MDOF_TRY(const auto channels, read_channels(table, context.rig, [&](TomlTable& channel) {
             keys.push_back(labjack::read_input_keys(channel));
           }));
  settings.encoder = encoder_origin(channels, is_at_counter(channels, counters()));
  for (std::size_t i = 0; i < channels.size(); ++i) {
    MDOF_TRY(const auto use, labjack::input_use("U6", channels[i], keys[i], kAins, counters()));
    inputs.push_back(input_of(channels[i], keys[i], use, gain));
    uses.push_back(use);
  }
  MDOF_CHECK(labjack::check_uses(channels, uses));
  const bool analogue =
      std::any_of(inputs.begin(), inputs.end(), [](const Input& input) { return input.ain >= 0; });
  if (!analogue)
    return bad_input(
        channels.front().where +
        ": a U6 streams its counter only together with an analogue input; add the AIN of a probe");
  return {};
}

}  // namespace

Result<Settings> read_labjack_u6(TomlTable& table, const DriverContext& context) {
  Settings settings;
  settings.name = context.name;
  MDOF_CHECK(read_inputs(table, context, settings));
  read_serial(table, settings);
  read_converter(table, settings);
  read_rate(table, settings);
  MDOF_CHECK(table.finish());
  return settings;
}

Result<DriverSpec> configure_labjack_u6(TomlTable& table, const DriverContext& context) {
  MDOF_TRY(const Settings settings, read_labjack_u6(table, context));
  DriverSpec spec;
  for (const Input& input : settings.inputs) spec.channels.push_back(input.channel.id);
  spec.encoder = settings.encoder;
  spec.make = make_of<LabjackU6>(settings);
  return spec;
}

}  // namespace mdof::drivers
