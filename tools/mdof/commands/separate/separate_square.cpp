// mdof separate square RUN_X RUN_Y RUN_X2 RUN_Y2: calculates the squareness of X and Y with a
// square whose angle is unknown.
#include <CLI/CLI.hpp>
#include <array>

#include "daemon/measure/budgets.h"
#include "daemon/words/words.h"
#include "schema/run_json.h"
#include "schema/uncertainty/run_uncertainty.h"
#include "schema/units.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/stored/database.h"
#include "tools/mdof/stored/run_choice.h"
#include "tools/mdof/terminal.h"
#include "tools/mdof/text/analyses/budget_text.h"
#include "tools/mdof/text/notice_lines.h"
#include "tools/mdof/text/run_tables.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

struct SquareCommand {
  std::string database;
  std::array<std::string, 4> word;  // runs of X, Y, X, Y
  bool partial = false, json = false, all_warnings = false;
};

std::string covers_of(const SquareReversal& s) {
  return s.noise_only ? "noise and repeatability only"
                      : "noise, and the uncertainties that the rig files declare; mdof treats "
                        "these uncertainties as common to both set-ups and takes their largest "
                        "possible effect";
}

std::string json_of(const SquareReversal& s, const std::array<std::int64_t, 4>& run,
                    const daemon::FoundSquareReversal& found) {
  JsonWriter json;
  json.begin_object().key("runs").begin_array();
  for (const std::int64_t id : run) json.value(id);
  json.end_array();
  write_reference(json, kAtFixture);
  json.field("EC0Y_urad", to_urad(s.EC0Y_rad))
      .field("artefact_angle_error_urad", to_urad(s.square_rad));
  json.field("u_urad", to_urad(s.u_rad)).field("u_random_urad", to_urad(s.u_random_rad));
  json.field("u_declared_urad", to_urad(s.u_declared_rad)).field("U_urad", to_urad(s.U_rad));
  json.field("k", s.coverage_factor).field("nu_eff", s.freedom);
  json.field("first_EC0Y_urad", to_urad(s.first_rad))
      .field("second_EC0Y_urad", to_urad(s.second_rad));
  write_covers(json, covers_of(s), found.not_declared);
  json.field("simulated", found.simulated).end_object();
  return with_notices(json.take(), found.notices, words::text);
}

std::string text_of(const SquareReversal& s, bool simulated) {
  TextTable table({"", "EC0Y/µrad"});
  table.add({"first set-up, square taken as exact", in_urad(s.first_rad)});
  table.add({"second set-up, square taken as exact", in_urad(s.second_rad)});
  const auto angle = [&s](double angle_rad) {
    return with_u(urad_to_place(angle_rad, s.U_rad), urad_to_place(s.u_rad, s.u_rad));
  };
  return noise_only_notice(s.noise_only) + simulated_notice(simulated) + table.text() +
         "\nEC0Y = " + angle(s.EC0Y_rad) +
         " µrad, expanded U = " + urad_to_place(s.U_rad, s.U_rad) +
         " (k = " + fixed(s.coverage_factor, 2) +
         ", 95 %)\n"
         "the angle from +X to +Y is 90° + EC0Y\n"
         "the angle of the square is 90° + " +
         angle(s.square_rad) + " µrad (key artefact_angle_error_urad of a rig)\n" +
         wrapped("± is the standard uncertainty u. It contains " + covers_of(s) +
                     ". Slopes refer to the fixture. The angle of the square is assumed to be "
                     "equal in both set-ups.",
                 terminal_columns()) +
         "\n";
}

Status square(const SquareCommand& command) {
  std::array<std::int64_t, 4> run{};
  for (std::size_t i = 0; i < run.size(); ++i) {
    MDOF_TRY(run[i], run_number(command.database, command.word[i], i % 2 == 0 ? Axis::x : Axis::y));
  }
  MDOF_TRY(store::Store store, open_to_read(command.database));
  MDOF_TRY(const auto found, daemon::square_reversal(store, {run[0], run[1], {}, command.partial},
                                                     {run[2], run[3], {}, command.partial}));
  show_notices(found.notices, command.all_warnings);
  Budget budget;
  budget.not_declared = found.not_declared;
  budget.noise_only = found.found.noise_only;
  if (const std::string text = not_declared_text({budget}); !text.empty()) warn(text);
  if (command.json) return write_line(json_of(found.found, run, found));
  return write_out(text_of(found.found, found.simulated));
}

Action declare_separate_square(CLI::App& command) {
  const auto o = std::make_shared<SquareCommand>();
  add_run_argument(command, "RUN_X", o->word[0], "Number of the run along X in the first set-up");
  add_run_argument(command, "RUN_Y", o->word[1], "Number of the run along Y in the first set-up");
  add_run_argument(command, "RUN_X2", o->word[2],
                   "Number of the run along X, after the square was turned over");
  add_run_argument(command, "RUN_Y2", o->word[3],
                   "Number of the run along Y, after the square was turned over");
  command.add_flag("--partial", o->partial, "Also accept partial runs");
  add_database_option(command, o->database);
  add_json_flag(command, o->json);
  add_all_warnings_flag(command, o->all_warnings);
  return [o] { return square(*o); };
}

}  // namespace

Command separate_square_command() {
  return {
      .name = "separate square",
      .summary =
          "Separate the squareness of the machine from the angle of a square that was turned over",
      .footer =
          "mdof calculates EC0Y of each set-up as if the square were exact. The two values are "
          "called first and second here. EC0Y of the machine = (first + second)/2. The angle error "
          "of the square is half of the difference between first and second; the planes in the "
          "rigs determine the sign of this error.\n"
          "Example:\n"
          "  mdof separate square 1 2 3 4",
      .declare = declare_separate_square};
}

}  // namespace mdof::tools
