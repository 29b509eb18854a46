#include "drivers/mcc_usb1608fs_plus/configure.h"

#include <algorithm>

#include "drivers/channels.h"
#include "drivers/mcc_usb1608fs_plus/mcc_usb1608fs_plus.h"

namespace mdof::drivers {
namespace {

using namespace mcc_usb1608fs_plus;

void read_converter(TomlTable& table, Settings& settings) {
  settings.serial = table.string("serial", "");
  const auto range = range_of(table.number("range_v", settings.range.volts));
  if (!range) return table.reject("range_v", "must be 10, 5, 2 or 1");
  settings.range = *range;
}

void read_rate(TomlTable& table, Settings& settings) {
  const double inputs = static_cast<double>(settings.inputs.size());
  const double most_hz = std::min(kMostRate_Hz, kMostSamples_Hz / inputs);
  settings.rate_hz = table.number("rate_hz", settings.rate_hz);
  if (!(settings.rate_hz >= 1 && settings.rate_hz <= most_hz))
    table.reject("rate_hz", "must be from 1 to " + std::to_string(static_cast<int>(most_hz)) +
                                " with " + std::to_string(settings.inputs.size()) +
                                " inputs (limits: 100000 scans/s, 400000 samples/s in total)");
}

Result<Input> input_of(const ChannelInput& channel) {
  std::vector<std::string> known;
  for (std::size_t n = 0; n < kInputs; ++n) known.push_back("CH" + std::to_string(n));
  const auto at = std::find(known.begin(), known.end(), channel.input);
  if (at == known.end()) return no_such_input(channel, known);
  if (channel.um_per_count != 0)
    return bad_input(
        channel.where + ": " + channel.input +
        " gives volts, not counts; remove um_per_count, and state the scale in the rig "
        "(um_per_V, also for the encoder)");
  return Input{{channel.id, Unit::volt}, static_cast<std::size_t>(at - known.begin())};
}

}  // namespace

Result<Settings> read_mcc_usb1608fs_plus(TomlTable& table, const DriverContext& context) {
  Settings settings;
  settings.name = context.name;
  MDOF_TRY(const auto channels, read_channels(table, context.rig));
  for (const ChannelInput& channel : channels) {
    MDOF_TRY(const Input input, input_of(channel));
    settings.inputs.push_back(input);
  }
  settings.encoder = encoder_origin(channels, false);
  read_converter(table, settings);
  read_rate(table, settings);
  MDOF_CHECK(table.finish());
  return settings;
}

Result<DriverSpec> configure_mcc_usb1608fs_plus(TomlTable& table, const DriverContext& context) {
  MDOF_TRY(const Settings settings, read_mcc_usb1608fs_plus(table, context));
  DriverSpec spec;
  for (const Input& input : settings.inputs) spec.channels.push_back(input.channel.id);
  spec.encoder = settings.encoder;
  spec.make = make_of<MccUsb1608fsPlus>(settings);
  return spec;
}

}  // namespace mdof::drivers
