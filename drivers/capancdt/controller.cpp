#include "drivers/capancdt/controller.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "drivers/capancdt/command_port.h"
#include "schema/base/number/number_text.h"

namespace mdof::drivers::capancdt {
namespace {

constexpr int kMostSample_us = 10'000'000;
constexpr double kRangeTolerance = 1e-3;  // relative to the range; the controller rounds the ranges

tl::unexpected<Error> wrong(const std::string& what, const std::string& remedy) {
  return io_error(what + "; " + remedy);
}

// Reads the identity from the version, from the controller information ($COI) or from the welcome
// text.
Status identify(CommandPort& port, const Options& options, Setup& setup) {
  MDOF_TRY(const Welcome welcome, port.welcome());
  MDOF_TRY(const std::string version, port.ask("$VER"));
  MDOF_TRY(const auto information, port.ask_if_known("$COI"));
  const std::string reported = field(information.value_or(""), "SNO");
  setup.serial = reported.empty() ? welcome.serial : reported;
  const std::string name = version.substr(0, version.find(';'));
  const std::string rest = version.substr(std::min(name.size() + 1, version.size()));
  setup.description = name.empty() ? welcome.name : name;
  if (!setup.serial.empty()) setup.description += ", serial " + setup.serial;
  if (!rest.empty()) setup.description += ", " + rest.substr(0, rest.find(';'));
  if (options.serial.empty() || options.serial == setup.serial) return {};
  return wrong("the controller is \"" + setup.description +
                   "\", but the configuration has serial = " + options.serial,
               "correct the key \"serial\" or \"address\"");
}

Status set(CommandPort& port, const std::string& command, std::optional<int> value) {
  if (!value) return {};
  MDOF_CHECK(port.ask(command + std::to_string(*value)));
  return {};
}

Status change_settings(CommandPort& port, const Options& options) {
  const auto& averaging = options.averaging;
  MDOF_CHECK(set(port, "$TRG", 0));
  if (averaging) MDOF_CHECK(set(port, "$AVT", static_cast<int>(*averaging)));
  MDOF_CHECK(set(port, "$AVN", options.averaged_values));
  return set(port, "$STI", options.sample_time_us);
}

// Returns nullopt if the controller does not know the command.
Result<std::optional<int>> setting(CommandPort& port, const std::string& command) {
  MDOF_TRY(const auto text, port.ask_if_known(command));
  if (!text) return std::nullopt;
  const auto value = parse_integer(*text);
  if (!value) return io_error("the answer to " + command + " is \"" + *text + "\", not a number");
  return value;
}

constexpr const char* kCorrectOne =
    "correct one of the two values, or set configure = true, so that the driver writes the "
    "configured value to the controller";

Status check(const char* key, std::optional<int> wanted, std::optional<int> is) {
  if (!wanted || !is || *wanted == *is) return {};
  return wrong(std::string(key) + " is " + std::to_string(*is) + " on the controller, but " +
                   std::to_string(*wanted) + " in the configuration",
               kCorrectOne);
}

std::string averaging_text(int type) {
  if (type < 0 || type > static_cast<int>(Averaging::dynamic)) return std::to_string(type);
  return std::string("\"") + to_string(static_cast<Averaging>(type)) + "\"";
}

// The error message contains the names that the configuration uses.
Status check_averaging(std::optional<Averaging> wanted, std::optional<int> is) {
  if (!wanted || !is || static_cast<int>(*wanted) == *is) return {};
  return wrong("averaging is " + averaging_text(*is) + " on the controller, but " +
                   averaging_text(static_cast<int>(*wanted)) + " in the configuration",
               kCorrectOne);
}

Status read_averaging(CommandPort& port, const Options& options, Setup& setup) {
  MDOF_TRY(const auto type, setting(port, "$AVT?"));
  MDOF_CHECK(check_averaging(options.averaging, type));
  const int kind = type.value_or(static_cast<int>(options.averaging.value_or(Averaging::none)));
  if (kind == static_cast<int>(Averaging::none)) return {};
  MDOF_TRY(const auto values, setting(port, "$AVN?"));
  MDOF_CHECK(check("averaged_values", options.averaged_values, values));
  setup.window = std::clamp(values.value_or(options.averaged_values.value_or(1)), 1, 1024);
  if (kind == static_cast<int>(Averaging::arithmetic)) setup.averaged = setup.window;
  return {};
}

// Returns $LIN of each input, in the order of the controller; empty: unknown.
Result<std::vector<int>> linearisations(CommandPort& port) {
  MDOF_TRY(const auto text, port.ask_if_known("$LIN?"));
  return parse_channel_list(text.value_or("")).value_or(std::vector<int>{});
}

// Reads the corrections that the controller applies without a report. Each result must state them.
Status read_corrections(CommandPort& port, const Options& options, Setup& setup) {
  MDOF_TRY(const auto modes, linearisations(port));
  if (modes.empty()) setup.notices.push_back(notice(NoticeCode::linearisation_unknown));
  for (std::size_t i = 0; i < setup.inputs.size(); ++i) {
    const auto& channel = options.channels[i];
    const auto at = static_cast<std::size_t>(channel.number - 1);
    if (at >= modes.size() || modes[at] == 0) continue;
    setup.inputs[i].linearisation = modes[at];
    setup.notices.push_back(channel.rig_corrects
                                ? notice(NoticeCode::linearised_twice, channel.input.id,
                                         {{"mode", modes[at]}, {"input", channel.input.input}})
                                : notice(NoticeCode::linearised_by_controller, channel.input.id,
                                         {{"mode", modes[at]}}));
  }
  MDOF_TRY(const auto low_pass, port.ask_if_known("$ALP?"));
  setup.low_pass = parse_integer(low_pass.value_or("")).value_or(0);
  if (setup.low_pass != 0)
    setup.notices.push_back(notice(NoticeCode::low_pass_on, "", {{"mode", setup.low_pass}}));
  return {};
}

Status read_settings(CommandPort& port, const Options& options, Setup& setup) {
  MDOF_TRY(const auto trigger, setting(port, "$TRG?"));
  if (trigger.value_or(0) != 0)
    return wrong("the controller waits for a trigger (TRG " + std::to_string(*trigger) +
                     "), so the counter in the data does not measure time",
                 "set the trigger to continuous, or set configure = true in the configuration");
  MDOF_CHECK(read_averaging(port, options, setup));
  MDOF_TRY(const auto time_us, setting(port, "$STI?"));
  if (!time_us)
    return wrong("the controller does not know the command \"$STI?\"",
                 "this driver needs a controller of the family 6200, not 6500");
  if (*time_us < 1 || *time_us > kMostSample_us)
    return io_error("the controller reports a sample time of " + std::to_string(*time_us) +
                    " us, which is not from 1 to " + std::to_string(kMostSample_us));
  setup.sample_time_us = *time_us;
  MDOF_CHECK(check_filter(setup.sample_time_us, setup.window, options.settle_s));
  // The controller selects a sample time that it supports (1200 -> 960, manual). The driver uses
  // the actual sample time.
  return options.configure ? Status{} : check("sample_time_us", options.sample_time_us, time_us);
}

std::vector<std::string> present(const std::vector<int>& channels) {
  std::vector<std::string> numbers;
  for (std::size_t i = 0; i < channels.size(); ++i)
    if (channels[i] != 0) numbers.push_back(std::to_string(i + 1));
  return numbers;
}

Result<Setup::Input> read_input(CommandPort& port, const Options::Channel& channel) {
  const std::string command = "$CHI" + std::to_string(channel.number);
  MDOF_TRY(const auto reply, port.ask_if_known(command));
  const std::string info = reply.value_or("");
  // Without this check, a late reply to $CHI12 would be accepted as a reply to $CHI1.
  if (!info.empty() && info.front() != ':')
    return io_error("the answer to " + command + " is \"" + info +
                    "\", which belongs to another command");
  const auto stated_um = channel_range_um(info);
  const std::string& where = channel.input.where;
  if (!stated_um && channel.range_um == 0)
    return wrong(where + ": the controller does not report the range of channel " +
                     channel.input.input + " as a length",
                 "set the key \"range_um\" of this channel");
  const double range_um = channel.range_um > 0 ? channel.range_um : *stated_um;
  if (stated_um && std::abs(range_um - *stated_um) > kRangeTolerance * *stated_um)
    return wrong(where + ": range_um is " + plain_number(range_um) +
                     ", but the controller reports " + plain_number(*stated_um) + " for channel " +
                     channel.input.input,
                 "correct or remove range_um");
  return Setup::Input{range_um, false};
}

Status read_inputs(CommandPort& port, const Options& options, Setup& setup) {
  MDOF_TRY(const std::string text, port.ask("$CHS"));
  const auto channels = parse_channel_list(text);
  if (!channels) return io_error("the answer to $CHS is \"" + text + "\", not a list of channels");
  for (const auto& channel : options.channels) {
    const auto index = static_cast<std::size_t>(channel.number - 1);
    if (index >= channels->size() || (*channels)[index] == 0)
      return no_such_input(channel.input, present(*channels));
    MDOF_TRY(auto input, read_input(port, channel));
    input.maths = (*channels)[index] == 2;
    setup.inputs.push_back(input);
  }
  return {};
}

Status read_data_port(CommandPort& port, const Options& options, Setup& setup) {
  setup.data_port = options.data_port.value_or(kDataPort);
  if (options.data_port) return {};
  MDOF_TRY(const auto reported, setting(port, "$GDP"));
  setup.data_port = reported.value_or(kDataPort);
  if (setup.data_port >= 1 && setup.data_port <= 65535) return {};
  return io_error("the controller reports data port " + std::to_string(setup.data_port) +
                  ", which is not a port number from 1 to 65535; set the key \"data_port\" in the "
                  "configuration");
}

Result<Setup> dialogue(CommandPort& port, const Options& options) {
  Setup setup;
  MDOF_CHECK(identify(port, options, setup));
  MDOF_CHECK(read_inputs(port, options, setup));
  if (options.configure) MDOF_CHECK(change_settings(port, options));
  MDOF_CHECK(read_settings(port, options, setup));
  MDOF_CHECK(read_corrections(port, options, setup));
  MDOF_CHECK(read_data_port(port, options, setup));
  return setup;
}

}  // namespace

const char* to_string(Averaging averaging) {
  constexpr std::array<const char*, 5> kNames = {"none", "moving", "arithmetic", "median",
                                                 "dynamic"};
  return kNames.at(static_cast<std::size_t>(averaging));
}

Status check_filter(double sample_time_us, int averaged_values, double settle_s) {
  const double filter_s = sample_time_us * 1e-6 * averaged_values;
  if (settle_s <= 0 || averaged_values < 2 || filter_s <= settle_s) return {};
  return wrong("the averaging takes " + plain_number(filter_s) +
                   " s, which is longer than settle_s = " + plain_number(settle_s) +
                   " s, so the first readings of each stop would still contain motion",
               "lower averaged_values or sample_time_us, or raise [measure] settle_s to " +
                   plain_number(filter_s));
}

Result<Setup> set_up_controller(const Options& options) {
  MDOF_TRY(auto stream, connect_tcp(options.command, kConnect));
  CommandPort port(std::move(stream), options.reply_timeout);
  auto setup = dialogue(port, options);
  if (!setup) return in_context(options.command.text(), setup.error());
  return setup;
}

}  // namespace mdof::drivers::capancdt
