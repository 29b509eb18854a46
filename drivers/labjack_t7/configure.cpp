#include "drivers/labjack_t7/configure.h"

#include <algorithm>

#include "drivers/channels.h"
#include "drivers/io/device_lock.h"
#include "drivers/labjack/input_keys.h"
#include "drivers/labjack_t7/labjack_t7.h"

namespace mdof::drivers {
namespace {

using namespace labjack_t7;

constexpr int kCommandPort = 502, kStreamPort = 702;
constexpr double kMostSamples_Hz = 100'000;  // samples of all inputs together
// The firmware handles each edge. The limit for a T7 that streams comes from LabJack's support and
// is quoted from memory; the limit was not verified.
constexpr double kMostCounts_per_s = 70'000;
constexpr int kMostResolution = 8, kMostSettling_us = 4400;

void read_endpoints(TomlTable& table, Settings& settings) {
  const std::string address = table.string("address");
  const auto command = parse_endpoint(address, kCommandPort);
  if (!command) return table.reject("address", command.error().message);
  settings.command = settings.stream = *command;
  const std::int64_t port = table.integer("stream_port", kStreamPort);
  if (port < 1 || port > 65535) table.reject("stream_port", "must be from 1 to 65535");
  settings.stream.port = static_cast<int>(port);
}

void read_converter(TomlTable& table, Settings& settings) {
  settings.range_v = table.number("range_v", settings.range_v);
  if (!range_index(settings.range_v)) table.reject("range_v", labjack::kRangesText);
  const std::int64_t resolution = table.integer("resolution_index", 0);
  if (resolution < 0 || resolution > kMostResolution)
    table.reject("resolution_index", "must be from 0 (the default) to 8");
  settings.resolution_index = static_cast<int>(resolution);
  settings.settling_us = table.number("settling_us", 0);
  if (!(settings.settling_us >= 0 && settings.settling_us <= kMostSettling_us))
    table.reject("settling_us", "must be from 0 (automatic) to 4400");
  const std::int64_t serial = table.integer("serial", 0);
  if (serial < 0 || serial > UINT32_MAX)
    table.reject("serial",
                 "must be the serial number of a T7, a whole number from 1 to 4294967295");
  settings.serial = static_cast<std::uint32_t>(serial);
}

void read_rate(TomlTable& table, Settings& settings) {
  const std::size_t words = scan_list(settings.inputs).size();
  settings.rate_hz = table.number("rate_hz", settings.rate_hz);
  if (!(settings.rate_hz >= 1 && settings.rate_hz * static_cast<double>(words) <= kMostSamples_Hz))
    return table.reject(
        "rate_hz",
        "must be from 1 to " + std::to_string(static_cast<int>(kMostSamples_Hz) / words) +
            ": a T7 measures at most 100000 samples/s, and a scan of these "
            "inputs has " +
            std::to_string(words) + " samples (1 for an analogue input, 2 for a counter)");
  const auto automatic = static_cast<std::int64_t>(quick_packet(settings.rate_hz, words));
  const std::int64_t samples = table.integer("samples_per_packet", automatic);
  if (samples < 1 || samples > static_cast<std::int64_t>(labjack_t7::kMostSamples) ||
      samples % static_cast<std::int64_t>(words) != 0)
    table.reject("samples_per_packet", "must be a multiple of " + std::to_string(words) +
                                           " (samples per scan) and at most 512");
  settings.samples_per_packet = static_cast<std::size_t>(samples);
}

std::vector<std::string> counters() {
  std::vector<std::string> names;
  for (const int line : kQuadratureLines) names.push_back("DIO" + std::to_string(line));
  return names;
}

Input input_of(const ChannelInput& channel, const labjack::InputKeys& keys,
               const labjack::InputUse& use) {
  Input input;
  input.channel = {channel.id, use.ain < 0 ? Unit::um : Unit::volt};
  input.ain = use.ain;
  input.negative = use.negative;
  if (use.ain >= 0) {
    input.range_v = keys.range_v;
    return input;
  }
  input.dio = kQuadratureLines[static_cast<std::size_t>(use.counter)];
  input.um_per_count = channel.um_per_count;
  input.most_counts_per_s = keys.most_counts_per_s > 0 ? keys.most_counts_per_s : kMostCounts_per_s;
  return input;
}

}  // namespace

Result<Settings> read_labjack_t7(TomlTable& table, const DriverContext& context) {
  Settings settings;
  settings.name = context.name;
  std::vector<labjack::InputKeys> keys;
  std::vector<labjack::InputUse> uses;
  const auto more = [&](TomlTable& channel) { keys.push_back(labjack::read_input_keys(channel)); };
  MDOF_TRY(auto channels, read_channels(table, context.rig, more));
  MDOF_CHECK(read_further_channels(context.further, more, channels));
  for (std::size_t i = 0; i < channels.size(); ++i) {
    MDOF_TRY(const auto use, labjack::input_use("T7", channels[i], keys[i], kAins, counters()));
    settings.inputs.push_back(input_of(channels[i], keys[i], use));
    uses.push_back(use);
  }
  MDOF_CHECK(labjack::check_uses(channels, uses));
  settings.encoder = encoder_origin(channels, is_at_counter(channels, counters()));
  settings.further_encoders = further_encoders(channels, context.further, counters());
  read_endpoints(table, settings);
  read_converter(table, settings);
  read_rate(table, settings);
  MDOF_CHECK(table.finish());
  return settings;
}

Result<DriverSpec> configure_labjack_t7(TomlTable& table, const DriverContext& context) {
  MDOF_TRY(const Settings settings, read_labjack_t7(table, context));
  DriverSpec spec;
  for (const Input& input : settings.inputs) spec.channels.push_back(input.channel.id);
  spec.encoder = settings.encoder;
  spec.further_encoders = settings.further_encoders;
  spec.identity = [at = settings.command] { return identity_of(at); };
  spec.make = make_of<LabjackT7>(settings);
  return spec;
}

}  // namespace mdof::drivers
