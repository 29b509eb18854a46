// mdof squareness RUN_A RUN_B: the angle between two axes, with its standard uncertainty.
#include <CLI/CLI.hpp>
#include <array>
#include <optional>

#include "daemon/history.h"
#include "daemon/measure/evaluation.h"
#include "daemon/measure/gate/gate.h"
#include "daemon/output/charts/run/run_charts.h"
#include "daemon/words/words.h"
#include "schema/units.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/stored/database.h"
#include "tools/mdof/stored/database_writer.h"
#include "tools/mdof/stored/json_read.h"
#include "tools/mdof/stored/run_choice.h"
#include "tools/mdof/terminal.h"
#include "tools/mdof/text/analyses/budget_text.h"
#include "tools/mdof/text/notice_lines.h"
#include "tools/mdof/text/run_tables.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

struct SquarenessCommand {
  std::string database, socket, axes;
  std::array<std::string, 2> words;
  std::int64_t run_a = 0, run_b = 0;
  std::optional<double> artefact_urad, u_artefact_urad;
  std::string plots;
  bool partial = false, json = false, all_warnings = false;
};

Result<daemon::FittedSquareness> fit(const SquarenessCommand& command) {
  MDOF_TRY(store::Store store, open_to_write(command.database));
  daemon::SquarenessRequest request{command.run_a,
                                    command.run_b,
                                    {},
                                    command.partial,
                                    daemon::action_now("squareness.fit", daemon::this_process())};
  if (command.artefact_urad) request.given.angle_error_rad = from_urad(*command.artefact_urad);
  if (command.u_artefact_urad) request.given.u_rad = from_urad(*command.u_artefact_urad);
  return daemon::fit_squareness(store, request);
}

std::vector<std::string> line_row(const std::string& label, const SquarenessLines& lines,
                                  double SquarenessLine::*value, const std::string& least_squares) {
  return {label, least_squares, in_urad(lines.end_point.*value),
          in_urad(lines.minimum_zone.*value)};
}

std::string of_run(std::int64_t run) {
  return ", run " + std::to_string(run);
}

std::string squareness_text(const Squareness& s, const std::vector<Budget>& budgets,
                            const SquarenessLines& lines) {
  const Budget& budget = budgets.front();
  TextTable table({"slope/µrad", "least squares", "end points", "minimum zone"});
  table.add(line_row(s.straightness_a() + of_run(s.run_a), lines, &SquarenessLine::slope_a_rad,
                     urad_with_u(s.slope_a_rad, s.u_slope_a_rad)));
  table.add(line_row(s.straightness_b() + of_run(s.run_b), lines, &SquarenessLine::slope_b_rad,
                     urad_with_u(s.slope_b_rad, s.u_slope_b_rad)));
  const std::string name = squareness_name(s.axes);
  const double u_artefact = s.artefact.u_rad.value_or(0);
  const std::string artefact = urad_to_place(squareness_of(s.axes, 0, 0, s.artefact), u_artefact);
  table.add({"artefact",
             s.artefact.u_rad ? with_u(artefact, urad_to_place(u_artefact, u_artefact)) : artefact,
             artefact, artefact});
  table.add(
      line_row(name, lines, &SquarenessLine::error_rad, urad_to_place(s.error_rad, budget.U)));
  return noise_only_notice(budget.noise_only) + simulated_notice(s.simulated) + table.text() +
         "\n" + name + " = " +
         with_u(urad_to_place(s.error_rad, budget.U), urad_to_place(budget.u, budget.u)) +
         " µrad, expanded U = " + urad_to_place(budget.U, budget.U) +
         " (k = " + fixed(budget.coverage_factor, 2) + ", 95 %)\n" + squareness_sense(s.axes, "°") +
         "\nform " + in_urad(s.form_rad) + " µrad: residual straightness of both axes\n" +
         wrapped("± is the standard uncertainty u. It contains " + covers_text(budget) +
                     ". \"mdof budget\" lists the contributors. Slopes refer to the fixture.",
                 terminal_columns()) +
         "\n";
}

Result<RunHeader> stored_header(const std::string& database, std::int64_t run) {
  MDOF_TRY(store::Store store, open_to_read(database));
  return store.run_header(run);
}

// mdofd has the database: it fits and stores. What it stored is read like that of this program, so
// that both say the same.
Result<daemon::FittedSquareness> fit_there(rpc::Client& mdofd, const SquarenessCommand& command) {
  JsonWriter params;
  params.begin_object();
  for (const std::int64_t run : {command.run_a, command.run_b}) {
    MDOF_TRY(const RunHeader header, stored_header(command.database, run));
    params.field(std::string("run_") + static_cast<char>(letter(header.axis) - 'A' + 'a'), run);
  }
  if (command.artefact_urad) params.field("artefact_angle_error_urad", *command.artefact_urad);
  if (command.u_artefact_urad) params.field("u_artefact_urad", *command.u_artefact_urad);
  if (command.partial) params.field("partial", true);
  params.end_object();
  MDOF_TRY(const std::string reply, mdofd.call("squareness.fit", params.text()));
  simdjson::dom::parser parser;
  const auto json = parser.parse(simdjson::padded_string(reply));
  const auto id = integer(json, "squareness");
  MDOF_TRY(store::Store store, open_to_read(command.database));
  MDOF_TRY(const auto stored, store.squareness_of(command.run_a, command.run_b));
  for (const auto& s : stored)
    if (s.id == id) return daemon::stored_squareness(store, s);
  return io_error("the database does not contain the squareness that mdofd stored: " + reply);
}

Status draw_both_axes(const SquarenessCommand& command, const Squareness& s, const Budget& budget) {
  if (command.plots.empty()) return {};
  MDOF_TRY(store::Store store, open_to_read(command.database));
  charts::SquarenessResults drawn{s, budget, {}, {}};
  MDOF_TRY(drawn.run_a, daemon::run_stated_at(store, s.run_a, Reference::fixture));
  MDOF_TRY(drawn.run_b, daemon::run_stated_at(store, s.run_b, Reference::fixture));
  const std::string name =
      "squareness-" + std::to_string(s.run_a) + "-" + std::to_string(s.run_b) + ".svg";
  return write_plots({{name, charts::squareness_svg(drawn, words::Language::english)}},
                     command.plots);
}

Status squareness(SquarenessCommand command) {
  MDOF_TRY(const auto runs, run_pair(command.database, command.words, command.axes));
  command.run_a = runs[0];
  command.run_b = runs[1];
  MDOF_TRY(auto mdofd, mdofd_that_writes(command.database, command.socket));
  MDOF_TRY(const auto fitted, mdofd ? fit_there(*mdofd, command) : fit(command));
  const auto& [s, budgets, notices] = fitted;
  show_notices(notices, command.all_warnings);
  if (const std::string text = not_declared_text({budgets.front()}); !text.empty()) warn(text);
  MDOF_TRY(store::Store store, open_to_read(command.database));
  MDOF_TRY(const SquarenessLines lines, daemon::lines_of_squareness(store, s));
  MDOF_CHECK(draw_both_axes(command, s, budgets.front()));
  return command.json ? write_line(daemon::squareness_document(fitted, lines))
                      : write_out(squareness_text(s, budgets, lines));
}

Action declare_squareness(CLI::App& command) {
  const auto o = std::make_shared<SquarenessCommand>();
  add_run_argument(command, "RUN_A", o->words[0],
                   "Number of the run along the first axis, or \"latest\"");
  add_run_argument(command, "RUN_B", o->words[1],
                   "Number of the run along the second axis (same square), or \"latest\"");
  add_axes_option(command, o->axes);
  command.add_option("--artefact-urad", o->artefact_urad,
                     "Angle error of the reference square [default: value in the rigs]");
  command
      .add_option("--u-artefact-urad", o->u_artefact_urad,
                  "Standard uncertainty of the angle error of the reference square")
      ->check(not_negative_number());
  command.add_flag("--partial", o->partial, "Also accept partial runs");
  add_database_option(command, o->database);
  add_socket_option(command, o->socket);
  add_plot_option(command, o->plots);
  add_json_flag(command, o->json);
  add_all_warnings_flag(command, o->all_warnings);
  return [o] { return squareness(*o); };
}

}  // namespace

Command squareness_command() {
  return {.name = "squareness",
          .summary = "Find the angle between two axes from a run along each axis",
          .footer =
              "Give the runs in the order X, Y, Z. X and Y give EC0Y; X and Z give EB0Z;\n"
              "Y and Z give EA0Z.\n"
              "Examples:\n"
              "  mdof squareness 1 2 --artefact-urad -1.3 --u-artefact-urad 0.4\n"
              "  mdof squareness latest latest --axes XZ",
          .declare = declare_squareness};
}

}  // namespace mdof::tools
