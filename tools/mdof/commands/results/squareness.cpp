// mdof squareness RUN_A RUN_B: calculates the angle between two axes with its standard uncertainty.
#include <CLI/CLI.hpp>
#include <array>
#include <cmath>
#include <optional>

#include "daemon/history.h"
#include "daemon/measure/evaluation.h"
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

using simdjson::dom::element;

struct SquarenessCommand {
  std::string database, socket, axes;
  std::array<std::string, 2> words;
  std::int64_t run_a = 0, run_b = 0;
  std::optional<double> artefact_urad, u_artefact_urad;
  std::string plots;
  bool partial = false, json = false, all_warnings = false;
};

Result<daemon::FittedSquareness> fit(store::Store& store, const SquarenessCommand& command,
                                     bool stored) {
  daemon::SquarenessRequest request{command.run_a,
                                    command.run_b,
                                    {},
                                    command.partial,
                                    daemon::action_now("squareness.fit", daemon::this_process())};
  if (command.artefact_urad) request.given.angle_error_rad = from_urad(*command.artefact_urad);
  if (command.u_artefact_urad) request.given.u_rad = from_urad(*command.u_artefact_urad);
  return stored ? daemon::fit_squareness(store, request)
                : daemon::calculate_squareness(store, request);
}

Result<std::string> fit_locally(const SquarenessCommand& command) {
  MDOF_TRY(store::Store store, open_existing_to_write(command.database));
  MDOF_TRY(const auto fitted, fit(store, command, true));
  MDOF_TRY(const SquarenessByLine lines,
           daemon::squareness_by_reference_line(store, fitted.squareness));
  return daemon::squareness_document(fitted, lines);
}

// If mdofd uses the database, mdofd calculates and stores the squareness.
Result<std::string> fit_in_daemon(rpc::Client& mdofd, const SquarenessCommand& command) {
  JsonWriter params;
  params.begin_object().field("run_a", command.run_a).field("run_b", command.run_b);
  if (command.artefact_urad) params.field("artefact_angle_error_urad", *command.artefact_urad);
  if (command.u_artefact_urad) params.field("u_artefact_angle_urad", *command.u_artefact_urad);
  if (command.partial) params.field("partial", true);
  return mdofd.call("squareness.fit", params.end_object().take());
}

AxisPair axes_in(const element& document) {
  std::vector<Axis> found;
  for (const auto& [key, axis] :
       {std::pair{"run_x", Axis::x}, {"run_y", Axis::y}, {"run_z", Axis::z}})
    if (integer(document, key)) found.push_back(axis);
  return found.size() == 2 ? AxisPair{found[0], found[1]} : AxisPair{};
}

// Reads the values in a JSON document of squareness, in SI units.
struct SquarenessDocument {
  const element& document;
  AxisPair axes = axes_in(document);
  std::string name = squareness_name(axes);

  double rad(const std::string& key) const { return from_urad(number(document, key + "_urad")); }
  // The value of a key for one of the reference lines.
  double by(const char* line, const std::string& key) const {
    return from_urad(number(document["lines"][line], key + "_urad"));
  }
  // The angle error of the artefact, with the sign convention of the squareness. The document
  // contains the angle of the material at the corner of the artefact, minus 90°.
  double artefact_rad() const {
    Squareness s;
    s.axes = axes;
    const double angle = rad("artefact_angle_error");
    const double rest = rad(name) -
                        squareness_of(axes, rad(slope_of(s.straightness_a())),
                                      rad(slope_of(s.straightness_b())), {}) -
                        rad("square_tilt");
    return angle == 0 || text(document, "artefact_corner").empty() ? 0 : std::copysign(angle, rest);
  }
  static std::string slope_of(const std::string& error) { return "slope_" + error; }
};

std::vector<std::string> line_row(const SquarenessDocument& said, const std::string& label,
                                  const std::string& key, const std::string& least_squares) {
  return {label, least_squares, in_urad(said.by("end_point", key)),
          in_urad(said.by("minimum_zone", key))};
}

void add_slope(TextTable& table, const SquarenessDocument& said, const std::string& error,
               Axis along) {
  const std::string key = SquarenessDocument::slope_of(error);
  const std::string run = std::string("run_") + static_cast<char>(letter(along) - 'A' + 'a');
  table.add(line_row(said,
                     error + ", run " + std::to_string(integer(said.document, run).value_or(0)),
                     key, urad_with_u(said.rad(key), said.rad("u_" + key))));
}

void add_artefact(TextTable& table, const SquarenessDocument& said) {
  const double u = said.rad("u_artefact_angle"), u_known = std::isnan(u) ? 0 : u;
  const std::string artefact = urad_to_place(said.artefact_rad(), u_known);
  table.add({"artefact", std::isnan(u) ? artefact : with_u(artefact, urad_to_place(u, u)), artefact,
             artefact});
}

std::string squareness_text(const SquarenessDocument& said) {
  const element& document = said.document;
  Squareness pair;
  pair.axes = said.axes;
  const double error = said.rad(said.name), U = said.rad("U_" + said.name),
               u = said.rad("u_" + said.name);
  TextTable table({"slope/µrad", "least squares", "end points", "minimum zone"});
  add_slope(table, said, pair.straightness_a(), pair.axes.a);
  add_slope(table, said, pair.straightness_b(), pair.axes.b);
  add_artefact(table, said);
  if (const double tilt = said.rad("square_tilt"); std::abs(tilt) > u / 20)
    table.add({"tilt of the square", urad_to_place(tilt, u), urad_to_place(tilt, u),
               urad_to_place(tilt, u)});
  table.add(line_row(said, said.name, said.name, urad_to_place(error, u)));
  return noise_only_notice(flag(document, "noise_only")) +
         simulated_notice(flag(document, "simulated")) + table.text() + "\n" + said.name + " = " +
         with_u(urad_to_place(error, u), urad_to_place(u, u)) +
         " µrad, expanded U = " + urad_to_place(U, U) + " (k = " + fixed(number(document, "k"), 2) +
         ", 95 %)\n" + squareness_sense(pair.axes, "°") + "\nform " + in_urad(said.rad("form")) +
         " µrad: residual straightness of both axes\n" +
         wrapped("± is the standard uncertainty u. It contains " + text(document, "u_covers") +
                     ". \"mdof budget\" lists the contributors. Slopes refer to the fixture. The "
                     "values of end points and minimum zone have no u, because mdof does not "
                     "calculate it.",
                 terminal_columns()) +
         "\n";
}

std::string undeclared_text(const element& document) {
  Budget budget;
  budget.not_declared = texts(document, "not_declared");
  budget.noise_only = flag(document, "noise_only");
  // If u contains declared sources, adds a line to the budget, because the text then shows the
  // budget.
  if (text(document, "u_covers").find(kNothingDeclared) == std::string::npos)
    budget.lines.emplace_back().key = "declared";
  return not_declared_text(std::vector{budget});
}

// Draws the chart from both runs in the database, because it needs the readings.
Status draw_squareness_chart(const SquarenessCommand& command) {
  if (command.plots.empty()) return {};
  MDOF_TRY(store::Store store, open_to_read(command.database));
  MDOF_TRY(const auto fitted, fit(store, command, false));
  const Squareness& s = fitted.squareness;
  charts::SquarenessResults drawn{s, fitted.budgets.front(), {}, {}};
  MDOF_TRY(drawn.run_a, daemon::restated_run(store, s.run_a, Reference::fixture));
  MDOF_TRY(drawn.run_b, daemon::restated_run(store, s.run_b, Reference::fixture));
  const std::string name =
      "squareness-" + std::to_string(s.run_a) + "-" + std::to_string(s.run_b) + ".svg";
  return write_plots({{name, charts::squareness_svg(drawn, words::Language::english)}},
                     command.plots);
}

Status squareness(SquarenessCommand command) {
  MDOF_TRY(const auto runs, run_pair(command.database, command.words, command.axes));
  command.run_a = runs[0];
  command.run_b = runs[1];
  MDOF_TRY(auto mdofd, writing_daemon(command.database, command.socket));
  MDOF_TRY(const std::string reply, mdofd ? fit_in_daemon(*mdofd, command) : fit_locally(command));
  simdjson::dom::parser parser;
  const element document = parser.parse(simdjson::padded_string(reply));
  show_notices(notices_of(document), command.all_warnings);
  if (const std::string text = undeclared_text(document); !text.empty()) warn(text);
  MDOF_CHECK(draw_squareness_chart(command));
  return command.json ? write_line(reply) : write_out(squareness_text({document}));
}

Action declare_squareness(CLI::App& command) {
  const auto o = std::make_shared<SquarenessCommand>();
  add_run_argument(command, "RUN_A", o->words[0],
                   "Number of the run along the first axis, or \"latest\"");
  add_run_argument(command, "RUN_B", o->words[1],
                   "Number of the run along the second axis (same square), or \"latest\"");
  add_axes_option(command, o->axes);
  add_square_options(command, o->artefact_urad, o->u_artefact_urad);
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
