// mdof machine diagonal MACHINE.toml | FILE.csv: predicts the deviations along the diagonals of the
// machine (ISO 230-6), or calculates the squareness of two axes from measured diagonals.
#include <CLI/CLI.hpp>
#include <cmath>

#include "algo/machine/geometric_tests/diagonal.h"
#include "drivers/csv/csv_table.h"
#include "schema/iso230/squareness.h"
#include "schema/units.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/commands/machine/machine_file.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/terminal.h"
#include "tools/mdof/text/run_tables.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

struct MachineDiagonalCommand {
  std::string file, database, plane = "XY", approach = "mean", measured;
  std::size_t steps = 20;
  double u_um = 0;
  bool json = false;
};

// A measured diagonal, compared with its prediction.
struct Compared {
  std::size_t readings = 0;
  double range_m = 0, largest_difference_m = 0;
};

double at_position(const algo::Diagonal& d, double at_m) {
  const double step = d.position_m[1] - d.position_m[0];
  const auto last = static_cast<double>(d.position_m.size() - 2);
  const double cell = std::min(std::max(std::floor(at_m / step), 0.0), last);
  const auto i = static_cast<std::size_t>(cell);
  const double part = (at_m - d.position_m[i]) / step;
  return d.deviation_m[i] + (d.deviation_m[i + 1] - d.deviation_m[i]) * part;
}

// Compares the readings along one diagonal with the prediction. Both are set to 0 at the first
// reading.
Result<Compared> compared(const algo::Diagonal& d, std::size_t number,
                          const drivers::CsvTable& csv) {
  Compared c;
  double low = 0, high = 0, zero = 0, predicted_zero = 0;
  for (std::size_t i = 0; i < csv.rows(); ++i) {
    if (csv.columns[0][i] != static_cast<double>(number)) continue;
    const double at = from_mm(csv.columns[1][i]);
    if (!(at >= -1e-9 && at <= d.position_m.back() + 1e-6))
      return bad_input(csv.where(i) + "position_mm is not on the diagonal (from 0 to " +
                       in_mm(d.position_m.back()) + " mm)");
    if (c.readings == 0) {
      zero = from_um(csv.columns[2][i]);
      predicted_zero = at_position(d, at);
    }
    const double deviation = from_um(csv.columns[2][i]) - zero;
    const double difference = deviation - (at_position(d, at) - predicted_zero);
    low = std::min(low, deviation);
    high = std::max(high, deviation);
    if (std::abs(difference) > std::abs(c.largest_difference_m))
      c.largest_difference_m = difference;
    ++c.readings;
  }
  c.range_m = high - low;
  return c;
}

constexpr const char* kNoU = "No uncertainty of these values is calculated.";

std::string diagonals_json(const Machine& machine, const std::vector<algo::Diagonal>& diagonals,
                           const std::vector<Compared>& measured) {
  JsonWriter json;
  json.begin_object()
      .field("machine", machine.name)
      .field("simulated", machine.simulated)
      .field("u_reason", kNoU)
      .key("diagonals")
      .begin_array();
  for (std::size_t i = 0; i < diagonals.size(); ++i) {
    const algo::Diagonal& d = diagonals[i];
    json.begin_object()
        .field("diagonal", static_cast<std::uint64_t>(i + 1))
        .field("name", d.name)
        .field("length_mm", to_mm(d.position_m.back()))
        .field("range_um", to_um(d.range_m));
    write_strings(json, "not_measured", d.not_measured);
    write_strings(json, "beyond_tables", d.beyond);
    json.key("points").begin_array();
    for (std::size_t k = 0; k < d.position_m.size(); ++k)
      json.begin_object()
          .field("position_mm", to_mm(d.position_m[k]))
          .field("deviation_um", to_um(d.deviation_m[k]))
          .end_object();
    json.end_array();
    if (!measured.empty() && measured[i].readings > 0)
      json.field("measured_range_um", to_um(measured[i].range_m))
          .field("largest_difference_um", to_um(measured[i].largest_difference_m));
    json.end_object();
  }
  json.end_array();
  write_stored_notices(json, machine);
  json.end_object();
  return json.take();
}

std::string diagonals_text(const Machine& machine, const std::vector<algo::Diagonal>& diagonals,
                           const std::vector<Compared>& measured) {
  TextTable table({"diagonal", "", "length/mm", "predicted/µm", "measured/µm", "difference/µm"}, 2);
  for (std::size_t i = 0; i < diagonals.size(); ++i) {
    const bool there = !measured.empty() && measured[i].readings > 0;
    table.add({std::to_string(i + 1), diagonals[i].name, in_mm(diagonals[i].position_m.back()),
               in_um(diagonals[i].range_m), there ? in_um(measured[i].range_m) : "",
               there ? in_um(measured[i].largest_difference_m) : ""});
  }
  return simulated_notice(machine.simulated) + machine.name +
         ": diagonals predicted from the errors of the machine\n" + table.text(terminal_columns()) +
         "predicted, measured: range (largest minus smallest) of the deviation of the\n"
         "tool along the diagonal (ISO 230-6)\n"
         "difference: measured minus predicted deviation, at the position with the\n"
         "largest magnitude of this difference\n" +
         kNoU + "\n" + missing_text(diagonals.front().not_measured, {}, terminal_columns());
}

Status predict(const MachineDiagonalCommand& o) {
  MDOF_TRY(const Machine machine, load_machine(o.file, o.database));
  MDOF_TRY(const auto diagonals, algo::plane_diagonals(machine, std::string("XYZ").find(o.plane[0]),
                                                       std::string("XYZ").find(o.plane[1]), o.steps,
                                                       approach_from(o.approach)));
  std::vector<Compared> measured;
  if (!o.measured.empty()) {
    MDOF_TRY(const auto csv,
             drivers::read_csv_table(o.measured, {"diagonal", "position_mm", "deviation_um"}));
    for (std::size_t i = 0; i < diagonals.size(); ++i) {
      MDOF_TRY(const Compared c, compared(diagonals[i], i + 1, csv));
      measured.push_back(c);
    }
    if (measured[0].readings + measured[1].readings < csv.rows())
      return bad_input(csv.source + ": column \"diagonal\" must be 1 (" + diagonals[0].name +
                       ") or 2 (" + diagonals[1].name + ")");
  }
  for (const auto& d : diagonals) warn_outside_tables(d.beyond);
  return o.json ? write_line(diagonals_json(machine, diagonals, measured))
                : write_out(diagonals_text(machine, diagonals, measured));
}

Result<algo::DiagonalLines> lines_of(const drivers::CsvTable& csv, double u_um) {
  algo::DiagonalLines lines;
  lines.u_line_m = from_um(u_um);
  algo::MeasuredLine* const of[] = {&lines.first, &lines.second, &lines.diagonal, &lines.other};
  for (std::size_t i = 0; i < csv.rows(); ++i) {
    const double line = csv.columns[0][i];
    if (!(line == 1 || line == 2 || line == 3 || line == 4))
      return bad_input(csv.where(i) +
                       "column \"line\" must be 1 (first axis), 2 (second axis), 3 (diagonal along "
                       "which both axes increase) or 4 (other diagonal)");
    of[static_cast<std::size_t>(line) - 1]->length_m.push_back(from_mm(csv.columns[1][i]) +
                                                               from_um(csv.columns[2][i]));
  }
  return lines;
}

AxisPair axes_of(const std::string& plane) {
  return {*axis_from(plane.substr(0, 1)), *axis_from(plane.substr(1))};
}

const char* covers_of(const MachineDiagonalCommand& o) {
  return o.u_um > 0 ? "repeatability and the declared u of each line" : "repeatability only";
}

std::string squareness_json(const MachineDiagonalCommand& o, const algo::DiagonalSquareness& s,
                            bool simulated) {
  JsonWriter json;
  const AxisPair axes = axes_of(o.plane);
  json.begin_object()
      .field("error", squareness_name(axes))
      .field("error_urad", squareness_sign(axes) * to_urad(s.angle_error_rad))
      .field("u_urad", to_urad(s.u_rad))
      .field("u_repeat_urad", to_urad(s.u_repeat_rad))
      .field("U_urad", to_urad(s.U_rad))
      .field("k", s.k)
      .field("nu_eff", s.freedom)
      .field("diagonals", s.two_diagonals ? 2 : 1)
      .field("sense", squareness_sense(axes, " deg"))
      .field("u_covers", covers_of(o))
      .field("noise_only", !(o.u_um > 0))
      .field("simulated", simulated)
      .end_object();
  return json.take();
}

Status squareness(const MachineDiagonalCommand& o) {
  MDOF_TRY(const auto csv, drivers::read_csv_table(o.file, {"line", "length_mm", "deviation_um"}));
  MDOF_TRY(const auto lines, lines_of(csv, o.u_um));
  auto s = algo::squareness_from_diagonals(lines);
  if (!s) return in_context(csv.source, std::move(s.error()));
  if (o.json) return write_line(squareness_json(o, *s, csv.simulated));
  const AxisPair axes = axes_of(o.plane);
  return write_out(
      noise_only_notice(!(o.u_um > 0)) + simulated_notice(csv.simulated) + squareness_name(axes) +
      " = " +
      with_u(urad_to_place(squareness_sign(axes) * s->angle_error_rad, s->U_rad),
             urad_to_place(s->u_rad, s->u_rad)) +
      " µrad, U = " + urad_to_place(s->U_rad, s->U_rad) + " (k = " + fixed(s->k, 2) + ", 95 %)\n" +
      squareness_sense(axes, "°") + "\nfrom " +
      (s->two_diagonals ? "both diagonals" : "one diagonal and the lengths of both axes") +
      "; u contains repeatability (" + urad_to_place(s->u_repeat_rad, s->u_repeat_rad) + " µrad)" +
      (o.u_um > 0 ? " and the declared u of each line"
                  : " only (declare u of the lines with --u-um)") +
      "\n"
      "a scale error that all lines have in common does not change this angle\n");
}

Status machine_diagonal(const MachineDiagonalCommand& o) {
  if (!std::isfinite(o.u_um)) return fail(ErrorCode::usage, "--u-um must be a finite number");
  const bool machine = o.file.size() > 5 && o.file.substr(o.file.size() - 5) == ".toml";
  if (!machine && !o.measured.empty())
    return fail(ErrorCode::usage,
                "--measured needs MACHINE.toml as FILE, because mdof compares the readings with "
                "the prediction");
  return machine ? predict(o) : squareness(o);
}

Action declare_machine_diagonal(CLI::App& command) {
  const auto o = std::make_shared<MachineDiagonalCommand>();
  command
      .add_option("FILE", o->file,
                  "MACHINE.toml to predict the diagonals, or CSV of measured lines. Columns of the "
                  "CSV: line (1: first axis, 2: second axis, 3: diagonal, 4: other diagonal), "
                  "length_mm and deviation_um. Each repeated measurement is another row")
      ->required()
      ->type_name("");
  command.add_option("--plane", o->plane, "Plane of the first and the second axis")
      ->check(CLI::IsMember({"XY", "XZ", "YZ"}))
      ->capture_default_str();
  command.add_option("--steps", o->steps, "Number of steps along each predicted diagonal")
      ->check(CLI::Range(std::size_t{1}, std::size_t{10'000}))
      ->capture_default_str();
  command
      .add_option("--measured", o->measured,
                  "CSV of measured diagonals to compare with the prediction; columns: diagonal (1 "
                  "or 2), position_mm, deviation_um")
      ->type_name("FILE.csv");
  command
      .add_option("--u-um", o->u_um,
                  "Standard uncertainty of the length of each line; mdof adds the repeatability")
      ->check(not_negative_number());
  add_approach_option(command, o->approach);
  add_database_option(command, o->database);
  add_json_flag(command, o->json);
  return [o] { return machine_diagonal(*o); };
}

}  // namespace

Command machine_diagonal_command() {
  return {
      .name = "machine diagonal",
      .summary = "Predict the diagonals of a machine, or find squareness from measured diagonals",
      .footer =
          "Examples:\n"
          "  mdof machine diagonal machine.toml --measured diagonals.csv\n"
          "  mdof machine diagonal lines.csv --u-um 0.2",
      .declare = declare_machine_diagonal};
}

}  // namespace mdof::tools
