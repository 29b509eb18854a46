// mdof separate reversal FIRST SECOND: separates the errors of machine and target from two runs or
// files. Between these, the target was turned by 180°.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <optional>

#include "schema/units.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/commands/separate/separation_output.h"
#include "tools/mdof/commands/separate/separation_sources.h"

namespace mdof::tools {
namespace {

struct ReversalCommand {
  SourceOptions of;
  OutputOptions output;
  std::optional<double> turned_at_mm;
};

// The middle of the places on the target that the first set-up measures. If the target is turned
// about this point, the second set-up measures the same places.
double middle_of_target(const algo::SeparationRequest& request) {
  const algo::SetUp& first = request.set_ups.front();
  const auto [low, high] = std::minmax_element(first.position_m.begin(), first.position_m.end());
  return (algo::place_on_target(request.at, first, *low) +
          algo::place_on_target(request.at, first, *high)) /
         2;
}

Status reversal(const ReversalCommand& command) {
  if (command.turned_at_mm && !std::isfinite(*command.turned_at_mm))
    return fail(ErrorCode::usage, "--turned-at-mm must be a position in mm");
  MDOF_TRY(LoadedSources loaded, load_sources(command.of));
  const Axis motion = loaded.record.axis, normal = loaded.record.normal;
  algo::SetUp& turned = loaded.request.set_ups[1];
  turned.turn = algo::half_turn(motion, normal, turned_about(command.of, motion));
  if (turned.turn.end_for_end) {
    const double at_m =
        command.turned_at_mm ? from_mm(*command.turned_at_mm) : middle_of_target(loaded.request);
    turned.shift_m = 2 * at_m;
  } else if (command.turned_at_mm) {
    return fail(
        ErrorCode::usage,
        "--turned-at-mm applies only to a target that was turned end for end; give --turned-about "
        "with an axis other than the moving axis, or leave out --turned-at-mm");
  }
  SeparationSource& source = loaded.record.sources[1];
  source.height_sign = turned.turn.height_sign;
  source.end_for_end = turned.turn.end_for_end;
  source.shift_m = turned.shift_m;
  return separate_and_print(std::move(loaded), "reversal", command.output);
}

Action declare_separate_reversal(CLI::App& command) {
  const auto o = std::make_shared<ReversalCommand>();
  command
      .add_option("SET_UP", o->of.sources,
                  "Two runs or two CSV files (columns position_mm, deviation_um, and u_um if "
                  "known): the first set-up, then the set-up with the turned target")
      ->required()
      ->expected(2)
      ->type_name("");
  add_source_options(command, o->of);
  command.add_option(
      "--turned-at-mm", o->turned_at_mm,
      "For a target that was turned end for end: position of the axis of rotation along the moving "
      "axis, in carriage coordinates [default: middle of the readings]");
  add_output_options(command, o->output);
  return [o] { return reversal(*o); };
}

}  // namespace

Command separate_reversal_command() {
  return {.name = "separate reversal",
          .summary = "Separate machine error and target shape by turning the target by 180°",
          .footer =
              "For a target that was turned about the moving axis: machine error = (first + "
              "second)/2 and target height = (first - second)/2, where first and second are the "
              "readings of the two set-ups. A fitted line is subtracted from both results.\n"
              "Examples:\n"
              "  mdof separate reversal 4 5 --surface side --probe D\n"
              "  mdof separate reversal a.csv b.csv --moves target --surface side --rig-toml \\\n"
              "    >> rig_X.toml",
          .declare = declare_separate_reversal};
}

}  // namespace mdof::tools
