#include "drivers/capancdt/configure.h"

#include <array>
#include <charconv>
#include <string>
#include <utility>

#include "drivers/capancdt/capancdt.h"
#include "drivers/capancdt/options.h"
#include "drivers/io/device_lock.h"

namespace mdof::drivers {
namespace {

using capancdt::Averaging;
using capancdt::Options;

constexpr std::int64_t kMostSampleTime_us = 10'000'000;
constexpr double kMostRange_um = 1e6;

// Returns nullopt if the key is missing.
std::optional<int> read_integer(TomlTable& table, const char* key, std::int64_t min,
                                std::int64_t max) {
  const bool given = table.has(key);
  const std::int64_t value = table.integer(key, min);
  if (value < min || value > max)
    table.reject(key, "must be from " + std::to_string(min) + " to " + std::to_string(max));
  return given ? std::optional(static_cast<int>(value)) : std::nullopt;
}

std::optional<Averaging> read_averaging(TomlTable& table) {
  constexpr std::array kAll = {Averaging::none, Averaging::moving, Averaging::arithmetic,
                               Averaging::median, Averaging::dynamic};
  const bool given = table.has("averaging");
  const std::string word = table.string("averaging", "none");
  std::vector<std::string> names;
  for (const Averaging averaging : kAll) {
    names.emplace_back(to_string(averaging));
    if (word == names.back()) return given ? std::optional(averaging) : std::nullopt;
  }
  const std::string near = nearest_candidate(word, names);
  table.reject("averaging", "must be \"none\", \"moving\", \"arithmetic\", \"median\" or " +
                                std::string("\"dynamic\"") +
                                (near.empty() ? "" : "; did you mean \"" + near + "\"?"));
  return std::nullopt;
}

void read_address(TomlTable& table, Options& options) {
  const std::string address = table.string("address");
  if (address.empty())
    return table.reject("address",
                        "must be the address of the controller, such as \"192.168.0.5\"");
  auto endpoint = parse_endpoint(address, capancdt::kCommandPort);
  if (!endpoint) return table.reject("address", endpoint.error().message);
  options.command = std::move(*endpoint);
}

Result<int> channel_number(const ChannelInput& channel) {
  const std::string& text = channel.input;
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error == std::errc() && end == text.data() + text.size() && number >= 1 &&
      number <= capancdt::kMostChannels && text[0] != '0')
    return number;
  return bad_input(channel.where + ": input \"" + text +
                   "\" is not a channel of a controller; give a number from \"1\" to \"" +
                   std::to_string(capancdt::kMostChannels) + "\"");
}

bool rig_corrects(const Rig& rig, const std::string& id) {
  const auto probe = rig.probe_index(id);
  if (!probe) return false;
  const Calibration& calibration = rig.probes[*probe].calibration;
  return !calibration.linearity.empty() || !calibration.polynomial_um.empty();
}

// Checks the values that are in the configuration. The driver checks the other values when it
// connects to the controller.
void check_averaging(TomlTable& table, const Options& options) {
  if (!options.averaging || *options.averaging == Averaging::none) return;
  if (!options.averaged_values || !options.sample_time_us) return;
  const Status checked =
      capancdt::check_filter(*options.sample_time_us, *options.averaged_values, options.settle_s);
  if (!checked) table.reject("averaged_values", checked.error().message);
}

Status read_channel_table(TomlTable& table, const DriverContext& context, Options& options) {
  std::vector<double> range_um;
  MDOF_TRY(
      auto inputs, read_channels(table, context.rig, [&](TomlTable& channel) {
        range_um.push_back(channel.number("range_um", 0));
        if (channel.has("range_um") && !(range_um.back() > 0 && range_um.back() <= kMostRange_um))
          channel.reject("range_um", "must be greater than 0 and at most 1000000");
        if (channel.has("um_per_count"))
          channel.reject("um_per_count",
                         "applies to encoders that count, not to probes; remove um_per_count");
      }));
  MDOF_CHECK(check_reads_stated(inputs, context.rig));
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    MDOF_TRY(const int number, channel_number(inputs[i]));
    const bool corrects = rig_corrects(context.rig, inputs[i].id);
    options.channels.push_back({std::move(inputs[i]), number, range_um[i], corrects});
  }
  return {};
}

Result<Options> read_options(TomlTable& table, const DriverContext& context) {
  Options options;
  options.name = context.name;
  read_address(table, options);
  options.data_port = read_integer(table, "data_port", 1, 65535);
  options.serial = table.string("serial", "");
  options.configure = table.boolean("configure", true);
  options.sample_time_us = read_integer(table, "sample_time_us", 1, kMostSampleTime_us);
  options.averaging = read_averaging(table);
  options.averaged_values = read_integer(table, "averaged_values", 2, 8);
  options.settle_s = context.settle_s;
  check_averaging(table, options);
  options.guard_counts = read_integer(table, "guard_counts", 0, capancdt::kFullScale / 4)
                             .value_or(options.guard_counts);
  MDOF_CHECK(read_channel_table(table, context, options));
  MDOF_CHECK(table.finish());
  return options;
}

}  // namespace

Result<DriverSpec> configure_capancdt(TomlTable& table, const DriverContext& context) {
  MDOF_TRY(const Options options, read_options(table, context));
  DriverSpec spec;
  for (const auto& channel : options.channels) {
    spec.channels.push_back(channel.input.id);
    if (channel.input.id == kEncoderChannel) spec.encoder = encoder_origin({channel.input}, false);
  }
  spec.identity = [at = options.command] { return identity_of(at); };
  spec.make = make_of<capancdt::Capancdt>(options);
  return spec;
}

}  // namespace mdof::drivers
