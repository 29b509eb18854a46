#include "drivers/labjack_u6/configure.h"

#include <algorithm>
#include <cmath>

#include "drivers/channels.h"
#include "drivers/labjack/count_guard.h"
#include "drivers/labjack_u6/labjack_u6.h"

namespace mdof::drivers {
namespace {

using namespace labjack_u6;

constexpr const char* kCounter = "FIO0";
constexpr double kMostSamples_Hz = 50'000;  // of all inputs
// Its firmware serves each edge: LabJack's manual of the U3, of the same kind.
constexpr double kMostCounts_per_s = 30'000;
constexpr int kMostResolution = 8, kMostSettling_us = 2550;

void read_serial(TomlTable& table, Settings& settings) {
  const std::int64_t serial = table.integer("serial", 0);
  if (serial < 0 || serial > UINT32_MAX) table.reject("serial", "is no serial number of a U6");
  if (serial > 0) settings.serial = std::to_string(serial);
}

void read_converter(TomlTable& table, Settings& settings) {
  const double range_v = table.number("range_v", 10);
  settings.gain = -1;
  for (int gain = 0; gain < 4; ++gain)
    if (std::abs(range_v * std::pow(10, gain) - 10) < 1e-9) settings.gain = gain;
  if (settings.gain < 0) table.reject("range_v", "must be 10, 1, 0.1 or 0.01");
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
    table.reject("rate_hz", "must be from 1 to " +
                                std::to_string(static_cast<int>(kMostSamples_Hz) / words) +
                                ": a U6 takes 50000 samples/s and a scan of these inputs has " +
                                std::to_string(words) + " (a counter two)");
}

std::vector<std::string> known_inputs() {
  std::vector<std::string> names;
  for (int n = 0; n < kAins; ++n) names.push_back("AIN" + std::to_string(n));
  names.emplace_back(kCounter);
  return names;
}

Result<Input> input_of(const ChannelInput& channel, double most_counts_per_s) {
  Input input;
  if (channel.input == kCounter) {
    MDOF_CHECK(check_um_per_count(channel));
    input.channel = {channel.id, Unit::um};
    input.um_per_count = channel.um_per_count;
    input.most_counts_per_s = most_counts_per_s > 0 ? most_counts_per_s : kMostCounts_per_s;
    return input;
  }
  const std::vector<std::string> known = known_inputs();
  const auto at = std::find(known.begin(), known.end(), channel.input);
  if (at == known.end()) return no_such_input(channel, known);
  if (channel.um_per_count != 0 || most_counts_per_s > 0)
    return bad_input(channel.where + ": " + channel.input +
                     " gives volts and counts nothing; take um_per_count and most_counts_per_s "
                     "away (the rig has um_per_V)");
  input.channel = {channel.id, Unit::volt};
  input.ain = static_cast<int>(at - known.begin());
  return input;
}

Status read_inputs(TomlTable& table, const DriverContext& context, Settings& settings) {
  auto& inputs = settings.inputs;
  std::vector<double> most;
  MDOF_TRY(const auto channels, read_channels(table, context.rig, [&](TomlTable& channel) {
             most.push_back(labjack::read_most_counts_per_s(channel));
           }));
  settings.encoder = encoder_origin(channels, counts_at(channels, kCounter));
  for (std::size_t i = 0; i < channels.size(); ++i) {
    MDOF_TRY(const Input input, input_of(channels[i], most[i]));
    inputs.push_back(input);
  }
  const bool analogue =
      std::any_of(inputs.begin(), inputs.end(), [](const Input& input) { return input.ain >= 0; });
  if (!analogue)
    return bad_input(
        channels.front().where +
        ": a U6 streams its counter only beside an analogue input; add one of a probe");
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
  spec.driver = "labjack_u6";
  spec.name = context.name;
  for (const Input& input : settings.inputs) spec.channels.push_back(input.channel.id);
  spec.encoder = settings.encoder;
  spec.make = [settings]() -> Result<std::unique_ptr<Driver>> {
    return std::make_unique<LabjackU6>(settings);
  };
  spec.source_info = [](const Driver&) { return SourceInfo{}; };
  return spec;
}

}  // namespace mdof::drivers
