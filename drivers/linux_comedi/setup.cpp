#include "drivers/linux_comedi/setup.h"

#include <cmath>

#include "schema/base/number/number_text.h"

namespace mdof::drivers::linux_comedi {
namespace {

constexpr double kRateTolerance = 0.01;  // relative to the requested rate
constexpr const char* kTestDriver = "comedi_test";
// The first test changes the arguments; the next test checks the changed arguments.
constexpr int kTests = 4;

std::string channel_text(unsigned channel) {
  return "CH" + std::to_string(channel);
}

// Returns the number of the subdevice.
Result<unsigned> find_subdevice(const std::vector<Subdevice>& all, const Settings& settings) {
  const auto fits = [](const Subdevice& one) { return one.analogue_input && one.streams; };
  std::string known;
  for (unsigned n = 0; n < all.size(); ++n) {
    if (!fits(all[n])) continue;
    if (!settings.subdevice || *settings.subdevice == n) return n;
    known += (known.empty() ? "" : ", ") + std::to_string(n);
  }
  if (known.empty())
    return bad_input(
        "the board has no analogue inputs that stream (asynchronous commands); to list its "
        "subdevices, run: comedi_board_info");
  return bad_input("subdevice " + std::to_string(*settings.subdevice) +
                   " has no analogue inputs that stream; possible subdevices: " + known);
}

Status check_reference(const Subdevice& subdevice, const InputSetting& input) {
  const auto bit = [](Reference reference) { return 1U << static_cast<unsigned>(reference); };
  if ((subdevice.references & bit(input.reference)) != 0) return {};
  std::string known;
  for (const Reference each :
       {Reference::ground, Reference::common, Reference::differential, Reference::other})
    if ((subdevice.references & bit(each)) != 0)
      known += (known.empty() ? " " : ", ") + std::string(name_of(each));
  return bad_input(channel_text(input.number) + ": reference = \"" + name_of(input.reference) +
                   "\" is not possible; the board offers" + known);
}

Result<BoardInput> board_input(Board& board, unsigned subdevice, const Subdevice& has,
                               const InputSetting& input) {
  if (input.number >= has.channels)
    return bad_input("the board has no input " + channel_text(input.number) +
                     "; the last input is " + channel_text(has.channels - 1));
  MDOF_CHECK(check_reference(has, input));
  const auto ranges = board.ranges(subdevice, input.number);
  if (const auto at = range_index(ranges, input.low_v, input.high_v))
    return BoardInput{input.number, *at, input.reference};
  std::string known;
  for (const Range& range : ranges) known += (known.empty() ? " " : ", ") + text_of(range);
  return bad_input(channel_text(input.number) + ": the board has no range " +
                   text_of({input.low_v, input.high_v}) + "; range_v can be" + known);
}

// Uses the nearest values that the board supports: test() changes the command to these values.
Status fit_command(Board& board, Command& command) {
  int failed = 0;
  for (int i = 0; i < kTests; ++i) {
    MDOF_TRY(failed, board.test(command));
    if (failed == 0) return {};
    // The results 3 and 4 mean that the board has changed arguments.
    if (failed != 3 && failed != 4) break;
  }
  const std::string inputs =
      failed == 5 ? "; the board cannot scan these inputs together with these ranges and references"
                  : "";
  return bad_input(std::string("the board refuses the command (") + failed_step(failed) + ")" +
                   inputs);
}

Status check_rate(const Command& command, double rate_hz) {
  const double true_hz = rate_of(command);
  if (std::abs(true_hz / rate_hz - 1) <= kRateTolerance) return {};
  const double each_us = convert_us(command);
  return bad_input(
      "the board cannot scan at rate_hz = " + plain_number(rate_hz) + "; the nearest rate is " +
      plain_number(true_hz, 9) + " Hz with " + std::to_string(command.inputs.size()) + " inputs" +
      (each_us > 0 ? ", converted at intervals of " + plain_number(each_us) + " us" : ""));
}

Notice uncalibrated(const std::string& why) {
  return notice(NoticeCode::board_not_calibrated, "", {{"reason", why}});
}

// Makes the conversions from the calibration file if there is one, otherwise from the ranges.
Status convert(Board& board, const Subdevice& has, Setup& setup) {
  const Command& command = setup.command;
  const Calibration calibration = board.calibrate(command.subdevice, command.inputs);
  const bool used = calibration.found && calibration.wrong.empty();
  for (std::size_t i = 0; i < command.inputs.size(); ++i) {
    const BoardInput& input = command.inputs[i];
    const std::uint32_t greatest_code = board.greatest_code(command.subdevice, input.channel);
    if (greatest_code == 0)
      return io_error(
          channel_text(input.channel) +
          ": the driver of the board does not report the largest code of the converter");
    const Range range = board.ranges(command.subdevice, input.channel).at(input.range);
    const bool corrected = used && calibration.to_volts.at(i).has_value();
    setup.conversions.push_back(
        {corrected ? *calibration.to_volts[i] : nominal(range, greatest_code), greatest_code});
    if (used && has.soft_calibrated && !corrected)
      setup.notices.push_back(uncalibrated(calibration.file + " contains no calibration of " +
                                           channel_text(input.channel) + " at " + text_of(range)));
  }
  if (calibration.found && !calibration.wrong.empty())
    setup.notices.push_back(uncalibrated(calibration.file + ": " + calibration.wrong));
  if (!calibration.found && has.soft_calibrated)
    setup.notices.push_back(
        uncalibrated("the board needs a software calibration, but " +
                     (calibration.file.empty() ? "the calibration file" : calibration.file) +
                     " does not exist; create this file with comedi_soft_calibrate"));
  setup.description +=
      used ? ", calibrated by " + calibration.file : ", nominal ranges without calibration";
  return {};
}

void describe(Board& board, const Settings& settings, Setup& setup) {
  const double each_us = convert_us(setup.command);
  setup.description = "Comedi " + board.driver() + " " + board.name() + " at " + settings.device +
                      ", subdevice " + std::to_string(setup.command.subdevice) + ", inputs " +
                      (each_us > 0 ? plain_number(each_us) + " us apart" : "at the same time") +
                      ", a buffer of " + plain_number(setup.buffer_s) + " s";
}

}  // namespace

Result<Setup> set_up(Board& board, const Settings& settings) {
  if (!settings.board.empty() && settings.board != board.name())
    return bad_input("the board is \"" + board.name() + "\" (driver " + board.driver() +
                     "), but the configuration has board = \"" + settings.board +
                     "\"; Linux assigns device numbers in the order of detection; correct the key "
                     "\"device\"");
  Setup setup;
  const auto subdevices = board.subdevices();
  MDOF_TRY(const unsigned subdevice, find_subdevice(subdevices, settings));
  const Subdevice& has = subdevices[subdevice];
  std::vector<BoardInput> inputs;
  for (const InputSetting& input : settings.inputs) {
    MDOF_TRY(const BoardInput one, board_input(board, subdevice, has, input));
    inputs.push_back(one);
  }
  MDOF_TRY(const Command sources, board.sources(subdevice));
  MDOF_TRY(setup.command,
           timed_command(sources, subdevice, inputs, {settings.rate_hz, settings.convert_us}));
  MDOF_CHECK(fit_command(board, setup.command));
  MDOF_CHECK(check_rate(setup.command, settings.rate_hz));
  setup.long_samples = has.long_samples;
  const double scan_bytes = static_cast<double>(inputs.size()) * (has.long_samples ? 4 : 2);
  setup.buffer_s =
      static_cast<double>(board.buffer_bytes(subdevice)) / scan_bytes / rate_of(setup.command);
  describe(board, settings, setup);
  if (board.driver() == kTestDriver) setup.notices.push_back(notice(NoticeCode::board_simulated));
  MDOF_CHECK(convert(board, has, setup));
  return setup;
}

}  // namespace mdof::drivers::linux_comedi
