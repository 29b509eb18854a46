// mdof separate shift SET_UP...: separates the errors of machine and target. The target is shifted
// by known lengths between the set-ups, and turned in some of them.
#include <CLI/CLI.hpp>
#include <cmath>

#include "schema/units.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/commands/separate/separation_output.h"
#include "tools/mdof/commands/separate/separation_sources.h"

namespace mdof::tools {
namespace {

struct ShiftCommand {
  SourceOptions of;
  OutputOptions output;
  std::vector<double> shift_mm;
  std::vector<std::size_t> turned;
};

Status check(const ShiftCommand& command) {
  const std::size_t set_ups = command.of.sources.size();
  if (command.shift_mm.size() != set_ups)
    return fail(ErrorCode::usage, "--shift-mm has " + std::to_string(command.shift_mm.size()) +
                                      " numbers for " + std::to_string(set_ups) +
                                      " set-ups; give one number for each set-up, 0 for the first");
  for (const double mm : command.shift_mm)
    if (!std::isfinite(mm))
      return fail(ErrorCode::usage, "each --shift-mm must be a finite length in mm");
  if (command.shift_mm.front() != 0)
    return fail(ErrorCode::usage,
                "the first --shift-mm must be 0, because shifts are relative to the first set-up");
  for (const std::size_t number : command.turned)
    if (number < 2 || number > set_ups)
      return fail(ErrorCode::usage, "--turned takes numbers of set-ups from 2 to " +
                                        std::to_string(set_ups) + ", not " +
                                        std::to_string(number));
  if (!command.of.turned_about.empty() && command.turned.empty())
    return fail(ErrorCode::usage,
                "--turned-about applies only to turned set-ups; give their numbers with --turned");
  return {};
}

Status shift(const ShiftCommand& command) {
  MDOF_CHECK(check(command));
  MDOF_TRY(LoadedSources loaded, load_sources(command.of));
  const Axis motion = loaded.record.axis;
  const algo::HalfTurn turn =
      algo::half_turn(motion, loaded.record.normal, turned_about(command.of, motion));
  for (const std::size_t number : command.turned) loaded.request.set_ups[number - 1].turn = turn;
  for (std::size_t k = 0; k < loaded.request.set_ups.size(); ++k) {
    algo::SetUp& set_up = loaded.request.set_ups[k];
    set_up.shift_m = from_mm(command.shift_mm[k]);
    SeparationSource& source = loaded.record.sources[k];
    source.height_sign = set_up.turn.height_sign;
    source.end_for_end = set_up.turn.end_for_end;
    source.shift_m = set_up.shift_m;
  }
  return separate_and_print(std::move(loaded), "shift", command.output);
}

Action declare_separate_shift(CLI::App& command) {
  const auto o = std::make_shared<ShiftCommand>();
  command
      .add_option("SET_UP", o->of.sources,
                  "Runs or CSV files (columns position_mm, deviation_um, and u_um if known)")
      ->required()
      ->expected(2, 64)
      ->type_name("");
  command
      .add_option(
          "--shift-mm", o->shift_mm,
          "Shift of the target in the + direction of the axis: one number for each set-up, 0 "
          "for the first. If the target was turned end for end, the number is the position of the "
          "zero point of the target")
      ->required()
      ->expected(2, 64)
      ->type_name("MM");
  command
      .add_option("--turned", o->turned,
                  "Numbers of the set-ups in which the target was turned by 180°")
      ->type_name("NUMBER");
  add_source_options(command, o->of);
  add_output_options(command, o->output);
  return [o] { return shift(*o); };
}

}  // namespace

Command separate_shift_command() {
  return {.name = "separate shift",
          .summary = "Separate machine error and target shape by shifts and turns of the target",
          .footer =
              "Positions must be equally spaced, and each shift must be a whole multiple of this "
              "spacing. Shifts alone cannot separate a parabola, or a periodic error whose period "
              "divides all shifts. With one more set-up, in which the target is turned about the "
              "moving axis but not shifted, mdof can separate all errors except offset and slope.\n"
              "Examples:\n"
              "  mdof separate shift 4 5 6 --shift-mm 0 5 15 --surface top\n"
              "  mdof separate shift a.csv b.csv c.csv --shift-mm 0 5 0 --turned 3 --moves target "
              "--surface side --json",
          .declare = declare_separate_shift};
}

}  // namespace mdof::tools
