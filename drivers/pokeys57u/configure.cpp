#include "drivers/pokeys57u/configure.h"

#include <cmath>

#include "drivers/channels.h"
#include "drivers/pokeys57u/pokeys57u.h"

namespace mdof::drivers {
namespace {

using namespace pokeys57u;

// Largest counting rates, counts per second: 2.5 times the highest frequency in the manual for each
// kind of encoder, with four counts in a period.
constexpr double kSlow_Hz = 10e3, kFast_Hz = 1e6, kUltraFast_Hz = 50e6;

std::vector<std::string> input_names() {
  std::vector<std::string> names;
  for (std::size_t i = 1; i <= kEncoders; ++i) names.push_back("encoder" + std::to_string(i));
  names.emplace_back("ultrafast");
  for (std::size_t i = 1; i <= kAnalogues; ++i) names.push_back("analogue" + std::to_string(i));
  return names;
}

// These keys extend the keys that the channels of all drivers have.
struct ChannelOptions {
  std::optional<std::uint8_t> options;
  double most_counts_per_s;
};

ChannelOptions read_channel(TomlTable& channel) {
  ChannelOptions read{{}, channel.number("most_counts_per_s", 0)};
  if (read.most_counts_per_s < 0 || !std::isfinite(read.most_counts_per_s))
    channel.reject("most_counts_per_s",
                   "must be 0 (the maximum count rate of the input) or greater");
  if (!channel.has("counting")) return read;
  const std::string counting = channel.string("counting");
  if (counting == "x1") read.options = kEnabled;
  if (counting == "x2") read.options = kEnabled | kCounts_x2;
  if (counting == "x4") read.options = kEnabled | kCounts_x4;
  if (!read.options) channel.reject("counting", "must be \"x1\", \"x2\" or \"x4\"");
  return read;
}

double most_counts_per_s(std::size_t index) {
  return index == kUltraFast ? kUltraFast_Hz : index < 3 ? kFast_Hz : kSlow_Hz;
}

Result<Input> make_input(const ChannelInput& channel, const ChannelOptions& more) {
  const auto names = input_names();
  Input input;
  input.name = channel.input;
  while (input.index < names.size() && names[input.index] != channel.input) ++input.index;
  if (input.index == names.size()) return no_such_input(channel, names);
  input.channel = {channel.id, input.counts() ? Unit::um : Unit::volt};
  if (input.counts()) MDOF_CHECK(check_um_per_count(channel));
  if (more.options && input.index >= kEncoders)
    return bad_input(
        channel.where +
        ": the key \"counting\" applies to encoder1 to encoder25 only; remove this key");
  input.um_per_count = channel.um_per_count;
  input.options = more.options;
  input.most_counts_per_s =
      more.most_counts_per_s > 0 ? more.most_counts_per_s : most_counts_per_s(input.index);
  return input;
}

Settings read_settings(TomlTable& table, const std::string& name) {
  Settings settings;
  settings.name = name;
  const std::int64_t serial = table.integer("serial", 0);
  if (serial < 0 || serial > UINT32_MAX)
    table.reject("serial", "must be a serial number, a whole number from 1 to 4294967295");
  settings.serial = static_cast<std::uint32_t>(serial);
  settings.poll_ms = table.number("poll_ms", settings.poll_ms);
  if (!(settings.poll_ms >= 1 && settings.poll_ms <= 10'000))
    table.reject("poll_ms", "must be from 1 to 10000");
  const std::int64_t timeout_ms =
      table.integer("response_timeout_ms", settings.response_timeout.count());
  if (timeout_ms < 5 || timeout_ms > 500)
    table.reject("response_timeout_ms", "must be from 5 to 500");
  settings.response_timeout = std::chrono::milliseconds(timeout_ms);
  return settings;
}

}  // namespace

Result<DriverSpec> configure_pokeys57u(TomlTable& table, const DriverContext& context) {
  Settings settings = read_settings(table, context.name);
  std::vector<ChannelOptions> more;
  MDOF_TRY(const auto channels, read_channels(table, context.rig, [&more](TomlTable& channel) {
             more.push_back(read_channel(channel));
           }));
  MDOF_CHECK(table.finish());
  bool counts = false;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    MDOF_TRY(Input input, make_input(channels[i], more[i]));
    counts = counts || (channels[i].id == kEncoderChannel && input.counts());
    settings.inputs.push_back(std::move(input));
  }
  DriverSpec spec;
  spec.channels = ids_of(channels);
  spec.encoder = encoder_origin(channels, counts);
  spec.make = make_of<PoKeys57u>(settings);
  return spec;
}

}  // namespace mdof::drivers
