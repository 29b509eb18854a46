// mdof machine study: repeats the whole study of Hwang, Song and Park with a simulated machine.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>

#include "algo/machine/study/grooving_study.h"
#include "schema/base/json_writer.h"
#include "schema/base/number/number_text.h"
#include "schema/base/output/output_files.h"
#include "schema/rig/chain.h"
#include "schema/units.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/csv/csv_text.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/terminal.h"
#include "tools/mdof/text/run_tables.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

// Results in the paper, µm.
struct PaperFigures {
  double x_um, y_um, diagonal_um;
};
constexpr double kMostStudySeed = 9e15;
constexpr PaperFigures kPaperBefore{11.59, 12.33, 17.3}, kPaperAfter{0.12, 0.71, 1.44};

struct MachineStudyCommand {
  std::string name, folder;
  std::int64_t seed = 1;
  bool json = false;
};

const algo::DiagonalRange& worst_diagonal(const algo::GroovingState& state) {
  return *std::max_element(
      state.diagonals.begin(), state.diagonals.end(),
      [](const auto& a, const auto& b) { return a.measured_m < b.measured_m; });
}

// ---- JSON ----

void write_grooving_state(JsonWriter& json, const char* key, const algo::GroovingState& s,
                          const PaperFigures& paper) {
  json.key(key).begin_object();
  json.key("range_by_equation_1").begin_object();
  json.field("x_um", to_um(s.estimated.x_m)).field("y_um", to_um(s.estimated.y_m));
  json.field("paper_x_um", paper.x_um).field("paper_y_um", paper.y_um).end_object();
  json.key("range_of_the_machine").begin_object();
  json.field("x_um", to_um(s.actual.x_m)).field("y_um", to_um(s.actual.y_m)).end_object();
  json.field("angle_error_urad", to_urad(s.angle_error_rad))
      .field("u_angle_error_urad", to_urad(s.u_angle_rad));
  json.key("squareness_by_equation_2").begin_object();
  json.field("angle_error_urad", to_urad(s.square.angle_error_rad))
      .field("u_urad", to_urad(s.square.u_rad))
      .field("U_urad", to_urad(s.square.U_rad))
      .field("by_one_diagonal_urad", to_urad(s.one_diagonal_angle_rad))
      .end_object();
  json.key("diagonals").begin_array();
  for (const algo::DiagonalRange& d : s.diagonals)
    json.begin_object()
        .field("diagonal", d.name)
        .field("predicted_range_um", to_um(d.predicted_m))
        .field("measured_range_um", to_um(d.measured_m))
        .field("largest_difference_um", to_um(d.difference_m))
        .end_object();
  json.end_array();
  json.field("diagonal_range_um", to_um(worst_diagonal(s).measured_m))
      .field("paper_diagonal_range_um", paper.diagonal_um)
      .end_object();
}

void write_fitted_tilt(JsonWriter& json, const char* key, const algo::Perpendicularity& p) {
  json.key(key).begin_object();
  json.field("EA0C_urad", to_urad(p.EA0C_rad)).field("EB0C_urad", to_urad(p.EB0C_rad));
  json.field("u_urad", to_urad(p.u_rad)).field("U_urad", to_urad(p.U_rad));
  json.field("residual_sd_um", to_um(p.residual_sd_m)).end_object();
}

void write_grooving_table(JsonWriter& json, const algo::GroovingTable& t) {
  json.key("rotary_table").begin_object();
  json.field("radius_mm", to_mm(t.radius_m));
  json.key("simulated_machine").begin_object();
  json.field("EA0C_urad", to_urad(t.EA0C_rad)).field("EB0C_urad", to_urad(t.EB0C_rad));
  json.end_object();
  write_fitted_tilt(json, "readings_alone", t.raw);
  write_fitted_tilt(json, "without_table_tilt", t.without_tilt);
  write_fitted_tilt(json, "without_table_tilt_and_axes", t.without_both);
  json.field("range_um", to_um(t.range_m))
      .field("range_without_table_tilt_um", to_um(t.range_without_tilt_m))
      .field("range_left_um", to_um(t.range_left_m))
      .end_object();
}

std::string grooving_json(const algo::GroovingStudy& s) {
  JsonWriter json;
  json.begin_object().field("study", "grooving").field("simulated", true);
  json.field("seed", static_cast<std::uint64_t>(s.seed));
  json.key("noise").begin_object();
  json.field("position_um", to_um(s.instruments.position_m))
      .field("square_urad", to_urad(s.instruments.square_rad))
      .field("line_um", to_um(s.instruments.line_m))
      .field("height_um", to_um(s.instruments.height_m))
      .field("tilt_urad", to_urad(s.instruments.tilt_rad))
      .field("repeats", static_cast<std::uint64_t>(s.instruments.repeats))
      .end_object();
  json.field(
      "sense",
      "a range is the largest minus the smallest value over 400 mm x 400 mm or along a diagonal");
  write_grooving_state(json, "before", s.before, kPaperBefore);
  write_grooving_state(json, "after", s.after, kPaperAfter);
  json.key("corrections").begin_object();
  json.field("nodes", static_cast<std::uint64_t>(s.corrections.nodes()))
      .field("interpolation_x_um", to_um(s.corrections.interpolation_m[0]))
      .field("interpolation_y_um", to_um(s.corrections.interpolation_m[1]))
      .end_object();
  write_grooving_table(json, s.table);
  json.end_object();
  return json.take();
}

// ---- text ----

std::string range_um(double m) {
  return fixed(to_um(m), 2);
}

std::string angle_urad(double rad) {
  return fixed(to_urad(rad), 2);
}

std::string grooving_plane_text(const algo::GroovingStudy& s) {
  const algo::GroovingState &a = s.before, &b = s.after;
  const auto number = [](double x) { return fixed(x, 2); };
  TextTable table({"range/µm", "before", "in the paper", "after", "in the paper "});
  table.add({"2-D errors along X, by Eq. 1", range_um(a.estimated.x_m), number(kPaperBefore.x_um),
             range_um(b.estimated.x_m), number(kPaperAfter.x_um)});
  table.add({"2-D errors along Y, by Eq. 1", range_um(a.estimated.y_m), number(kPaperBefore.y_um),
             range_um(b.estimated.y_m), number(kPaperAfter.y_um)});
  table.add(
      {"2-D errors along X, true value", range_um(a.actual.x_m), "", range_um(b.actual.x_m), ""});
  table.add(
      {"2-D errors along Y, true value", range_um(a.actual.y_m), "", range_um(b.actual.y_m), ""});
  for (std::size_t i = 0; i < a.diagonals.size(); ++i) {
    const std::string name = "diagonal " + a.diagonals[i].name;
    table.add({name + ", predicted", range_um(a.diagonals[i].predicted_m), "",
               range_um(b.diagonals[i].predicted_m), ""});
    table.add({name + ", measured", range_um(a.diagonals[i].measured_m), "",
               range_um(b.diagonals[i].measured_m), ""});
    table.add({name + ", largest difference", range_um(a.diagonals[i].difference_m), "",
               range_um(b.diagonals[i].difference_m), ""});
  }
  table.add({"larger diagonal, measured", range_um(worst_diagonal(a).measured_m),
             number(kPaperBefore.diagonal_um), range_um(worst_diagonal(b).measured_m),
             number(kPaperAfter.diagonal_um)});
  return table.text(terminal_columns());
}

std::string grooving_square_text(const algo::GroovingStudy& s) {
  TextTable table({"angle between X and Y minus 90°, in µrad", "before", "after"});
  const auto both = [](const algo::DiagonalSquareness& q) {
    return with_u(urad_to_place(q.angle_error_rad, q.u_rad), urad_to_place(q.u_rad, q.u_rad));
  };
  const auto in_the_middle = [](const algo::GroovingState& g) {
    return with_u(urad_to_place(g.angle_error_rad, g.u_angle_rad),
                  urad_to_place(g.u_angle_rad, g.u_angle_rad));
  };
  table.add(
      {"from straightness and optical square", in_the_middle(s.before), in_the_middle(s.after)});
  table.add({"from one diagonal (Eq. 2)", angle_urad(s.before.one_diagonal_angle_rad),
             angle_urad(s.after.one_diagonal_angle_rad)});
  table.add({"from both diagonals (Eq. 2)", both(s.before.square), both(s.after.square)});
  return table.text(terminal_columns());
}

std::string grooving_rotary_text(const algo::GroovingTable& t) {
  TextTable table({"perpendicularity/µrad", "EA0C", "EB0C", "u"});
  const auto add = [&](const char* name, const algo::Perpendicularity& p) {
    table.add({name, angle_urad(p.EA0C_rad), angle_urad(p.EB0C_rad), angle_urad(p.u_rad)});
  };
  add("readings without correction", t.raw);
  add("tilt of the table subtracted", t.without_tilt);
  add("tilt of the table, errors of X and Y subtracted", t.without_both);
  table.add({"true value (simulated machine)", angle_urad(t.EA0C_rad), angle_urad(t.EB0C_rad), ""});
  return table.text(terminal_columns()) +
         wrapped("range of the table height over one turn at radius " + in_mm(t.radius_m) +
                     " mm: " + range_um(t.range_m) + " µm; after subtraction of the table tilt: " +
                     range_um(t.range_without_tilt_m) +
                     " µm; after subtraction of the table tilt and the perpendicularity: " +
                     range_um(t.range_left_m) + " µm (from the errors of X and Y)",
                 terminal_columns()) +
         "\n";
}

std::string grooving_text(const algo::GroovingStudy& s) {
  const algo::GroovingInstruments& by = s.instruments;
  return simulated_notice(true) +
         wrapped(
             "Study of Hwang, Song and Park on an area of 400 mm x 400 mm. Eq. 1 and Eq. 2 are "
             "equations of the paper. Seed of the noise: " +
                 std::to_string(s.seed),
             terminal_columns()) +
         "\n" +
         wrapped("standard deviation of the noise of one reading: laser " +
                     fixed(to_um(by.position_m), 3) + " µm along an axis and " +
                     fixed(to_um(by.line_m), 3) +
                     " µm along a line or a diagonal, optical square " +
                     fixed(to_urad(by.square_rad), 2) + " µrad, indicator " +
                     fixed(to_um(by.height_m), 3) + " µm, level " + fixed(to_urad(by.tilt_rad), 2) +
                     " µrad; " + std::to_string(by.repeats) + " repeats",
                 terminal_columns()) +
         "\n\n" + grooving_plane_text(s) + "\n" + grooving_square_text(s) +
         wrapped(
             "± is the standard uncertainty u. The diagonals go through the corners of the area. "
             "The straightness lines go through the middle of the area. The angles differ because "
             "of the yaw of Y.",
             terminal_columns()) +
         "\n\n" + grooving_rotary_text(s.table) +
         wrapped(
             "A range is the largest minus the smallest value. The errors of the simulated "
             "machine, including the yaw of Y, were chosen such that the ranges before the "
             "correction are near the ranges in the paper. The study shows the method of the "
             "paper, not its machine. The corrections have " +
                 std::to_string(s.corrections.nodes()) +
                 " nodes; the option --out writes the corrections and the measured errors.",
             terminal_columns()) +
         "\n";
}

// ---- files ----

std::string toml_rows(const MachineFrame& frame, std::size_t k) {
  const ErrorFunction& f = frame.error[k];
  const std::string key = with_unit(error_name(frame, k), k);
  std::string text = key + " = [\n";
  for (std::size_t i = 0; i < f.position.size(); ++i)
    text += "  [" + plain_number(written_position(frame, f.position[i]), 9) + ", " +
            plain_number(to_key_unit(f.forward[i]), 9) + "],\n";
  return text + "]\nu_" + key + " = " + plain_number(to_key_unit(f.u.front()), 6) + "\n";
}

std::string toml_of_found(const Machine& machine) {
  std::string text = "name = \"" + machine.name + "\"\nsimulated = true\n[machine]\nchain = \"" +
                     machine.chain.text + "\"\ntravel = { Y = \"-\" }\n[tool]\npoint_mm = [" +
                     plain_number(to_mm(machine.tool_m[0]), 9) + ", " +
                     plain_number(to_mm(machine.tool_m[1]), 9) + ", " +
                     plain_number(to_mm(machine.tool_m[2]), 9) + "]\n";
  for (const MachineFrame& frame : machine.frames) {
    text += "[[axis]]\nid = \"" + frame.id + "\"\nholds_at_mm = [" +
            plain_number(to_mm(frame.at_m[0]), 9) + ", " + plain_number(to_mm(frame.at_m[1]), 9) +
            ", " + plain_number(to_mm(frame.at_m[2]), 9) + "]\npoint = \"" +
            (frame.point_moves ? "moving" : "standing") + "\"\nrange_mm = [0, 400]\n";
    for (std::size_t k = 0; k < kBodyErrors; ++k) {
      if (frame.error[k].known()) text += toml_rows(frame, k);
      if (!frame.location[k].value) continue;
      const std::string key = with_unit(location_name(frame, k), k);
      text += key + " = " + plain_number(to_urad(*frame.location[k].value), 9) + "\nu_" + key +
              " = " + plain_number(to_urad(frame.location[k].u.value_or(0)), 6) + "\n";
    }
  }
  return text;
}

std::string corrections_csv(const VolumetricTable& table) {
  CsvText csv;
  for (const char* name : {"X_mm", "Y_mm", "correction_X_um", "correction_Y_um"}) csv.cell(name);
  csv.end_row();
  for (std::size_t i = 0; i < table.nodes(); ++i) {
    const Vec3 at = table.command_at(i);
    csv.cell(to_mm(at[0]));
    csv.cell(to_mm(at[1]));
    csv.cell(to_um(table.correction_m[i][0]));
    csv.cell(to_um(table.correction_m[i][1]));
    csv.end_row();
  }
  return "# simulated\n" + csv.take();
}

Status write_grooving_files(const algo::GroovingStudy& study, const std::string& folder) {
  std::error_code ec;
  std::filesystem::create_directories(folder, ec);
  if (ec) return io_error(folder + ": cannot be created: " + ec.message());
  const std::filesystem::path to = folder;
  OutputFiles out(Existing::refuse);
  MDOF_TRY(const std::size_t machine, out.add(to / "machine.toml"));
  MDOF_CHECK(out.write(machine, toml_of_found(study.before.found)));
  MDOF_TRY(const std::size_t corrections, out.add(to / "corrections.csv"));
  MDOF_CHECK(out.write(corrections, corrections_csv(study.corrections)));
  MDOF_CHECK(out.publish());
  say((to / "machine.toml").string() +
      " contains the measured errors; build a table for a controller with: "
      "mdof compensation build --machine " +
      (to / "machine.toml").string() + " --plane XY --step-mm 20 --incomplete");
  return {};
}

Status machine_study(const MachineStudyCommand& o) {
  MDOF_TRY(const algo::GroovingStudy study,
           algo::grooving_study(static_cast<std::uint64_t>(o.seed), {}));
  if (!o.folder.empty()) MDOF_CHECK(write_grooving_files(study, o.folder));
  return o.json ? write_line(grooving_json(study)) : write_out(grooving_text(study));
}

Action declare_machine_study(CLI::App& command) {
  const auto o = std::make_shared<MachineStudyCommand>();
  command
      .add_option(
          "NAME", o->name,
          "Name of the study: grooving (Hwang, Song and Park; planar machine with a rotary table)")
      ->required()
      ->type_name("")
      ->check(CLI::IsMember({"grooving"}));
  command.add_option("--seed", o->seed, "Seed of the noise of the instruments")
      ->check(tools::number_in(0, kMostStudySeed))
      ->capture_default_str();
  command
      .add_option("--out", o->folder,
                  "Folder for machine.toml (measured errors) and corrections.csv; mdof creates the "
                  "folder if "
                  "it does not exist")
      ->type_name("DIR");
  add_json_flag(command, o->json);
  return [o] { return machine_study(*o); };
}

}  // namespace

Command machine_study_command() {
  return {
      .name = "machine study",
      .summary = "Repeat a published study of a machine: measure and compensate in simulation",
      .footer =
          "mdof calculates the 2-D errors from positioning, straightness and squareness (Eq. 1 of "
          "the paper). Measured diagonals give the squareness (Eq. 2) and check the result "
          "(ISO 230-6). Then mdof corrects the commands and measures again. A circular path gives "
          "the perpendicularity of the rotary table.\n"
          "Examples:\n"
          "  mdof machine study grooving\n"
          "  mdof machine study grooving --seed 7 --out study --json",
      .declare = declare_machine_study};
}

}  // namespace mdof::tools
