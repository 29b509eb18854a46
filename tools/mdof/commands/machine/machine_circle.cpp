// mdof machine circle MACHINE.toml --radius-mm R | FILE.csv: the circular test (ISO 230-4),
// predicted from the chain or measured with a ball bar.
#include <CLI/CLI.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "algo/compensation/table_limits.h"
#include "algo/machine/geometric_tests/circle.h"
#include "algo/machine/tool_error.h"
#include "algo/uncertainty/coverage.h"
#include "daemon/output/charts/machine/circle_chart.h"
#include "daemon/output/charts/plot_files.h"
#include "drivers/csv/csv_table.h"
#include "schema/base/number/number_text.h"
#include "schema/units.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/commands/machine/machine_file.h"
#include "tools/mdof/csv/csv_text.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/terminal.h"
#include "tools/mdof/text/run_tables.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

constexpr double kRadiansByDegree = std::numbers::pi / 180;
constexpr double kBallBarResolution_um = 0.1;

struct MachineCircleCommand {
  std::string file, database, plane = "XY", centre, measured, plots;
  std::optional<double> radius_mm;
  std::size_t angles = 360;
  bool csv = false, json = false;
};

// A predicted or measured circle with its figures.
struct FoundCircle {
  algo::CircularPath path;  // deviations after the centre was subtracted
  algo::CircularFigures figures;
};

// The largest difference "measured - predicted" and its angle. U is the expanded uncertainty (95 %,
// k = 1.96) of the prediction at this angle, from the u of the machine's errors. U_m does not
// include the uncertainty of the ball bar. NaN: no u is declared.
struct LargestDifference {
  double value_m = 0, angle_rad = 0, U_m = NAN;
  bool clockwise = false;
};

struct FoundCircles {
  const Machine* machine = nullptr;  // null: there is only a measured circle
  std::vector<std::string> not_measured, beyond;
  bool simulated = false;
  std::optional<FoundCircle> predicted, measured;
  std::optional<LargestDifference> largest;  // present if both circles are present
};

Result<FoundCircle> evaluated(algo::CircularPath path) {
  FoundCircle found;
  MDOF_TRY(found.figures, algo::circular_figures(path));
  found.path = algo::centred(path, found.figures);
  return found;
}

// Error: a radial deviation is too large for a machine, for example because it is in another unit.
Status check_deviations(const drivers::CsvTable& csv) {
  const double most_um = to_um(algo::TableLimits{}.length_m);
  for (const std::size_t column : {std::size_t{1}, std::size_t{2}})
    for (std::size_t row = 0; row < csv.columns[column].size(); ++row)
      if (std::abs(csv.columns[column][row]) > most_um)
        return bad_input(
            csv.where(row) + "column " + (column == 1 ? "ccw_um" : "cw_um") + ": " +
            plain_number(csv.columns[column][row]) + " um is beyond the limit of " +
            plain_number(most_um) +
            " um for a radial deviation; write the actual radius minus the nominal radius, in um");
  return {};
}

// Warns if the deviations are below the resolution of a ball bar; they are then probably in mm.
void warn_small(const drivers::CsvTable& csv) {
  double largest_um = 0;
  for (const std::size_t column : {std::size_t{1}, std::size_t{2}})
    for (const double x : csv.columns[column]) largest_um = std::max(largest_um, std::abs(x));
  if (largest_um > 0 && largest_um < kBallBarResolution_um)
    warn(csv.source + ": the largest deviation is " + plain_number(largest_um) +
         " um, which is less than the resolution of a ball bar (" +
         plain_number(kBallBarResolution_um) + " um); check that the values are in um, not in mm");
}

Result<algo::CircularPath> read_path(const drivers::CsvTable& csv) {
  MDOF_CHECK(check_deviations(csv));
  warn_small(csv);
  algo::CircularPath path;
  for (const double angle : csv.columns[0]) path.angle_rad.push_back(angle * kRadiansByDegree);
  for (const double x : csv.columns[1]) path.ccw_m.push_back(from_um(x));
  for (const double x : csv.columns[2]) path.cw_m.push_back(from_um(x));
  return path;
}

// The predicted deviation at an angle, interpolated linearly. `deviations`: values at equal steps
// of the angle, beginning at 0.
double predicted_at_angle(const std::vector<double>& deviations, double angle_rad) {
  const auto n = static_cast<double>(deviations.size());
  const double turns = angle_rad / (2 * std::numbers::pi);
  const double place = (turns - std::floor(turns)) * n;
  const auto i = static_cast<std::size_t>(place) % deviations.size();
  const double part = place - std::floor(place);
  return deviations[i] + (deviations[(i + 1) % deviations.size()] - deviations[i]) * part;
}

LargestDifference largest_difference(const FoundCircle& measured, const FoundCircle& predicted) {
  LargestDifference largest;
  largest.angle_rad = measured.path.angle_rad.front();
  const auto compare = [&](const std::vector<double>& of, const std::vector<double>& by, bool cw) {
    for (std::size_t i = 0; i < of.size(); ++i) {
      const double difference = of[i] - predicted_at_angle(by, measured.path.angle_rad[i]);
      if (std::abs(difference) > std::abs(largest.value_m))
        largest = {difference, measured.path.angle_rad[i], NAN, cw};
    }
  };
  compare(measured.path.ccw_m, predicted.path.ccw_m, false);
  compare(measured.path.cw_m, predicted.path.cw_m, true);
  return largest;
}

// U of the predicted radius at an angle, from the u of the tool position at this point. The errors
// along X, Y and Z count as independent.
double radius_U_at(const Machine& machine, const algo::CircleRequest& request, double angle_rad) {
  algo::Command command = request.centre;
  const double c = std::cos(angle_rad), s = std::sin(angle_rad);
  command[request.first] += request.radius_m * c;
  command[request.second] += request.radius_m * s;
  const algo::ToolError error = algo::tool_error(machine, command, algo::MachineApproach::mean);
  return algo::coverage_factor(std::numeric_limits<double>::infinity()) *
         std::hypot(c * error.u[static_cast<Eigen::Index>(request.first)],
                    s * error.u[static_cast<Eigen::Index>(request.second)]);
}

void write_figures(JsonWriter& json, const algo::CircularFigures& f) {
  json.field("G_ccw_um", to_um(f.G_ccw_m))
      .field("G_cw_um", to_um(f.G_cw_m))
      .field("Gb_um", to_um(f.Gb_m))
      .field("H_um", to_um(f.H_m))
      .field("D_um", to_um(f.D_m))
      .field("F_max_ccw_um", to_um(f.F_ccw_m[0]))
      .field("F_min_ccw_um", to_um(f.F_ccw_m[1]))
      .field("F_max_cw_um", to_um(f.F_cw_m[0]))
      .field("F_min_cw_um", to_um(f.F_cw_m[1]));
}

void write_circle(JsonWriter& json, const char* key, const std::optional<FoundCircle>& circle) {
  json.key(key);
  if (!circle) return static_cast<void>(json.null());
  json.begin_object();
  write_figures(json, circle->figures);
  json.key("points").begin_array();
  const algo::CircularPath& path = circle->path;
  for (std::size_t i = 0; i < path.angle_rad.size(); ++i) {
    json.begin_object().field("angle_deg", path.angle_rad[i] / kRadiansByDegree);
    if (!path.ccw_m.empty()) json.field("ccw_um", to_um(path.ccw_m[i]));
    if (!path.cw_m.empty()) json.field("cw_um", to_um(path.cw_m[i]));
    json.end_object();
  }
  json.end_array().end_object();
}

std::string circle_json(const MachineCircleCommand& o, const FoundCircles& found) {
  JsonWriter json;
  json.begin_object().key("machine");
  found.machine ? json.value(found.machine->name) : json.null();
  json.field("plane", o.plane).field("simulated", found.simulated);
  json.field("sense",
             "actual radius minus nominal radius, about the least-squares centre of all paths");
  json.field("u_reason", "no uncertainty is calculated for the prediction and the readings");
  write_strings(json, "not_measured", found.not_measured);
  write_strings(json, "beyond_tables", found.beyond);
  write_circle(json, "predicted", found.predicted);
  write_circle(json, "measured", found.measured);
  json.key("largest_difference_um");
  found.largest ? json.value(to_um(found.largest->value_m)) : json.null();
  json.key("largest_difference");
  if (found.largest) {
    const LargestDifference& at = *found.largest;
    json.begin_object().field("um", to_um(at.value_m));
    json.field("angle_deg", at.angle_rad / kRadiansByDegree)
        .field("path", at.clockwise ? "cw" : "ccw")
        .field("U_um", to_um(at.U_m))
        .key("within_U");
    std::isnan(at.U_m) ? json.null() : json.value(std::abs(at.value_m) <= at.U_m);
    json.end_object();
  } else {
    json.null();
  }
  if (found.machine) write_stored_notices(json, *found.machine);
  json.end_object();
  return json.take();
}

std::string circle_csv(const FoundCircles& found) {
  const FoundCircle& circle = found.predicted ? *found.predicted : *found.measured;
  CsvText csv;
  csv.cell("angle_deg");
  if (!circle.path.ccw_m.empty()) csv.cell("ccw_um");
  if (!circle.path.cw_m.empty()) csv.cell("cw_um");
  csv.end_row();
  for (std::size_t i = 0; i < circle.path.angle_rad.size(); ++i) {
    csv.cell(circle.path.angle_rad[i] / kRadiansByDegree);
    if (!circle.path.ccw_m.empty()) csv.cell(to_um(circle.path.ccw_m[i]));
    if (!circle.path.cw_m.empty()) csv.cell(to_um(circle.path.cw_m[i]));
    csv.end_row();
  }
  return csv.take();
}

std::string largest_text(const LargestDifference& at) {
  const std::string U = fixed(to_um(at.U_m), 3) + " µm";
  return wrapped(
             "largest difference (measured minus predicted): " + fixed(to_um(at.value_m), 3) +
                 " µm at " + fixed(at.angle_rad / kRadiansByDegree, 1) + "°, " +
                 (at.clockwise ? "clockwise" : "counter-clockwise") +
                 (std::isnan(at.U_m) ? "; U of the prediction is unknown, because the errors "
                                       "have no declared u"
                  : std::abs(at.value_m) <= at.U_m ? "; within U of the prediction (" + U + ")"
                                                   : "; beyond U of the prediction (" + U + ")"),
             terminal_columns()) +
         "\n";
}

std::string circle_text(const MachineCircleCommand& o, const FoundCircles& found) {
  TextTable table({"", "predicted/µm", "measured/µm"});
  const auto add = [&](const char* label, auto figure) {
    const auto cell = [&](const std::optional<FoundCircle>& circle) {
      const double x = circle ? figure(circle->figures) : NAN;
      return std::isnan(x) ? std::string("-") : fixed(to_um(x), 3);
    };
    table.add({label, cell(found.predicted), cell(found.measured)});
  };
  using Figures = algo::CircularFigures;
  add("G, counter-clockwise", [](const Figures& f) { return f.G_ccw_m; });
  add("G, clockwise", [](const Figures& f) { return f.G_cw_m; });
  add("G(b), both directions", [](const Figures& f) { return f.Gb_m; });
  add("H, hysteresis", [](const Figures& f) { return f.H_m; });
  add("D, mean radial deviation", [](const Figures& f) { return f.D_m; });
  add("F max, counter-clockwise", [](const Figures& f) { return f.F_ccw_m[0]; });
  add("F min, counter-clockwise", [](const Figures& f) { return f.F_ccw_m[1]; });
  add("F max, clockwise", [](const Figures& f) { return f.F_cw_m[0]; });
  add("F min, clockwise", [](const Figures& f) { return f.F_cw_m[1]; });
  std::string text = simulated_notice(found.simulated) +
                     (found.machine ? found.machine->name + ": " : std::string()) +
                     "circular test (ISO 230-4) in the plane " + o.plane +
                     (o.radius_mm ? ", radius " + in_mm(from_mm(*o.radius_mm)) + " mm" : "") +
                     "\n" + table.text(terminal_columns()) +
                     wrapped(
                         "G refers to the least-squares circle of each path. The other values "
                         "refer to the least-squares circle of all paths. No uncertainty of these "
                         "values is calculated.",
                         terminal_columns()) +
                     "\n";
  if (found.largest) text += largest_text(*found.largest);
  return text + missing_text(found.not_measured, {}, terminal_columns()) +
         "--csv and --json print the values at each angle\n";
}

Status predict(const MachineCircleCommand& o, Machine& machine, algo::CircleRequest& request,
               FoundCircles& found) {
  if (!o.radius_mm)
    return fail(ErrorCode::usage, "missing option --radius-mm (radius of the circle)");
  MDOF_TRY(machine, load_machine(o.file, o.database));
  request.first = std::string("XYZ").find(o.plane[0]);
  request.second = std::string("XYZ").find(o.plane[1]);
  request.radius_m = from_mm(*o.radius_mm);
  request.angles = o.angles;
  if (!o.centre.empty()) {
    MDOF_TRY(request.centre, command_from(machine, o.centre));
  }
  MDOF_TRY(auto predicted, algo::predicted_circle(machine, request));
  MDOF_TRY(found.predicted, evaluated(std::move(predicted.path)));
  found.machine = &machine;
  found.simulated = machine.simulated;
  found.not_measured = std::move(predicted.not_measured);
  found.beyond = std::move(predicted.beyond);
  return {};
}

Status draw_circles(const MachineCircleCommand& o, const FoundCircles& found) {
  if (o.plots.empty()) return {};
  const auto language = words::Language::english;
  charts::CirclesToDraw circles;
  circles.title = (found.machine ? found.machine->name + ": " : std::string()) +
                  output::phrase(output::Phrase::circular_test, language);
  circles.plane = o.plane;
  circles.simulated = found.simulated;
  if (found.predicted)
    circles.pictures.push_back({false, found.predicted->path, found.predicted->figures});
  if (found.measured)
    circles.pictures.push_back({true, found.measured->path, found.measured->figures});
  return write_plots({{"circle-" + o.plane + ".svg", charts::circles_svg(circles, language)}},
                     o.plots);
}

Status machine_circle(const MachineCircleCommand& o) {
  FoundCircles found;
  Machine machine;
  algo::CircleRequest request;
  const bool described = o.file.size() > 5 && o.file.substr(o.file.size() - 5) == ".toml";
  const std::string measured = described ? o.measured : o.file;
  if (described) MDOF_CHECK(predict(o, machine, request, found));
  if (!measured.empty()) {
    MDOF_TRY(const auto csv, drivers::read_csv_table(measured, {"angle_deg"}, {"ccw_um", "cw_um"}));
    if (csv.columns[1].empty() && csv.columns[2].empty())
      return bad_input(csv.source +
                       ": the columns ccw_um and cw_um are missing; add one or both (radial "
                       "deviations of the counter-clockwise and the clockwise path)");
    MDOF_TRY(algo::CircularPath path, read_path(csv));
    auto circle = evaluated(std::move(path));
    if (!circle) return in_context(csv.source, std::move(circle.error()));
    found.measured = std::move(*circle);
    found.simulated = found.simulated || csv.simulated;
  }
  if (found.predicted && found.measured) {
    found.largest = largest_difference(*found.measured, *found.predicted);
    found.largest->U_m = radius_U_at(machine, request, found.largest->angle_rad);
  }
  warn_outside_tables(found.beyond);
  MDOF_CHECK(draw_circles(o, found));
  if (o.csv && !found.not_measured.empty())
    warn("these errors were not measured, so the values do not contain them: " +
         joined(found.not_measured));
  return o.csv    ? write_out(circle_csv(found))
         : o.json ? write_line(circle_json(o, found))
                  : write_out(circle_text(o, found));
}

Action declare_machine_circle(CLI::App& command) {
  const auto o = std::make_shared<MachineCircleCommand>();
  command
      .add_option("FILE", o->file,
                  "MACHINE.toml to predict the test from the errors of the machine, or CSV of a "
                  "measured path. Columns of the CSV: angle_deg (from the first axis towards the "
                  "second axis), ccw_um and cw_um (radial deviations)")
      ->required()
      ->type_name("");
  command.add_option("--plane", o->plane, "The two axes of the circle")
      ->check(CLI::IsMember({"XY", "XZ", "YZ"}))
      ->capture_default_str();
  command
      .add_option("--radius-mm", o->radius_mm, "Radius of the circle; required with MACHINE.toml")
      ->check(positive_number());
  command
      .add_option("--centre", o->centre,
                  "Commanded positions of all axes at the centre, such as X=20,Y=30 [default: 0]")
      ->type_name("AXIS=MM");
  command.add_option("--angles", o->angles, "Number of angles in the prediction")
      ->check(CLI::Range(8, 100'000))
      ->capture_default_str();
  command
      .add_option("--measured", o->measured,
                  "CSV of a measured path to compare with the prediction")
      ->type_name("FILE");
  add_plot_option(command, o->plots);
  add_database_option(command, o->database);
  add_csv_and_json_flags(command, o->csv, o->json);
  return [o] { return machine_circle(*o); };
}

}  // namespace

Command machine_circle_command() {
  return {.name = "machine circle",
          .summary = "Predict a circular test (ISO 230-4) from errors, or evaluate a measured test",
          .footer =
              "Examples:\n"
              "  mdof machine circle machine.toml --radius-mm 20 --centre X=30,Y=30\n"
              "  mdof machine circle machine.toml --radius-mm 20 --measured ballbar.csv\n"
              "  mdof machine circle ballbar.csv",
          .declare = declare_machine_circle};
}

}  // namespace mdof::tools
