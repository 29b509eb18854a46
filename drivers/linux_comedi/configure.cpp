#include "drivers/linux_comedi/configure.h"

#include <algorithm>
#include <cmath>

#include "drivers/channels.h"
#include "drivers/io/device_lock.h"
#include "drivers/linux_comedi/linux_comedi.h"
#include "schema/base/number/number_text.h"

namespace mdof::drivers {
namespace {

using namespace linux_comedi;

constexpr double kLeastRate_Hz = 0.25, kMostRate_Hz = 1e6;  // the period has 32 bits, in ns
constexpr unsigned kMostNumber = 255;
constexpr std::int64_t kMostSubdevice = 255;

// Keys that may be in the table of a channel or of the device.
struct Wiring {
  double low_v = -10, high_v = 10;
  Reference reference = Reference::ground;
};

void read_range(TomlTable& table, Wiring& wiring) {
  if (!table.has("range_v")) return;
  if (table.is_array("range_v")) {
    const auto ends = table.numbers("range_v");
    if (ends.size() != 2 || !(ends[0] < ends[1]) || !std::isfinite(ends[1] - ends[0]))
      return table.reject(
          "range_v",
          "must be the two limits in volts, such as [0, 10], or one number (10 means -10 to 10 V)");
    wiring.low_v = ends[0];
    wiring.high_v = ends[1];
    return;
  }
  wiring.high_v = table.number("range_v");
  wiring.low_v = -wiring.high_v;
  if (!(wiring.high_v > 0 && std::isfinite(wiring.high_v)))
    table.reject("range_v", "must be greater than 0 (10 means -10 to 10 V)");
}

Wiring read_wiring(TomlTable& table, Wiring wiring) {
  read_range(table, wiring);
  const auto reference = reference_of(table.string("reference", name_of(wiring.reference)));
  if (!reference)
    table.reject("reference", "must be \"ground\", \"common\", \"differential\" or \"other\"");
  wiring.reference = reference.value_or(Reference::ground);
  return wiring;
}

void read_board(TomlTable& table, Settings& settings) {
  settings.device = table.string("device", settings.device);
  settings.board = table.string("board", "");
  if (!table.has("subdevice")) return;
  const std::int64_t subdevice = table.integer("subdevice");
  if (subdevice < 0 || subdevice > kMostSubdevice)
    return table.reject(
        "subdevice",
        "must be the number of a subdevice; to list the numbers, run: comedi_board_info");
  settings.subdevice = static_cast<unsigned>(subdevice);
}

void read_timing(TomlTable& table, Settings& settings) {
  settings.rate_hz = table.number("rate_hz", settings.rate_hz);
  if (!(settings.rate_hz >= kLeastRate_Hz && settings.rate_hz <= kMostRate_Hz))
    table.reject("rate_hz", "must be from 0.25 to 1000000");
  if (!table.has("convert_us")) return;
  settings.convert_us = table.number("convert_us");
  const double scan_us = 1e6 / settings.rate_hz;
  const double most_us = scan_us / static_cast<double>(settings.inputs.size());
  if (!(*settings.convert_us >= 0.1 && *settings.convert_us <= most_us))
    table.reject("convert_us", "must be from 0.1 to " + plain_number(most_us, 6) +
                                   " us, which is 1e6 / (rate_hz * number of inputs)");
}

Result<unsigned> number_of(const ChannelInput& channel) {
  for (unsigned n = 0; n <= kMostNumber; ++n)
    if (channel.input == "CH" + std::to_string(n)) return n;
  return bad_input(channel.where + ": input \"" + channel.input +
                   "\" is not an input of a board; give \"CH0\" for channel 0 of the subdevice, "
                   "\"CH1\" for channel 1 and so on");
}

Result<InputSetting> input_of(const ChannelInput& channel, const Wiring& wiring) {
  MDOF_TRY(const unsigned number, number_of(channel));
  if (channel.um_per_count != 0)
    return bad_input(channel.where + ": " + channel.input +
                     " gives volts; this driver does not read counters of Comedi boards; remove "
                     "um_per_count from this channel, and set um_per_V in the rig (also for an "
                     "encoder)");
  return InputSetting{
      {channel.id, Unit::volt}, number, wiring.low_v, wiring.high_v, wiring.reference};
}

}  // namespace

Result<Settings> read_linux_comedi(TomlTable& table, const DriverContext& context) {
  Settings settings;
  settings.name = context.name;
  const Wiring of_all = read_wiring(table, {});
  std::vector<Wiring> wirings;
  MDOF_TRY(const auto channels, read_channels(table, context.rig, [&](TomlTable& channel) {
             wirings.push_back(read_wiring(channel, of_all));
           }));
  for (std::size_t i = 0; i < channels.size(); ++i) {
    MDOF_TRY(const InputSetting input, input_of(channels[i], wirings[i]));
    settings.inputs.push_back(input);
  }
  settings.encoder = encoder_origin(channels, false);
  read_board(table, settings);
  read_timing(table, settings);
  MDOF_CHECK(table.finish());
  return settings;
}

Result<DriverSpec> configure_linux_comedi(TomlTable& table, const DriverContext& context) {
  MDOF_TRY(const Settings settings, read_linux_comedi(table, context));
  DriverSpec spec;
  for (const InputSetting& input : settings.inputs) spec.channels.push_back(input.channel.id);
  spec.encoder = settings.encoder;
  spec.identity = [device = settings.device] { return identity_of_path(device); };
  spec.make = make_of<LinuxComedi>(settings);
  return spec;
}

}  // namespace mdof::drivers
