#include "tools/mdof/text/volumetric_text.h"

#include <algorithm>
#include <cmath>

#include "daemon/measure/gate/active_json.h"
#include "schema/base/json_writer.h"
#include "schema/base/number/number_text.h"
#include "schema/units.h"
#include "schema/volumetric/volumetric_json.h"
#include "tools/mdof/csv/csv_text.h"
#include "tools/mdof/terminal.h"
#include "tools/mdof/text/run_tables.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

constexpr std::string_view kAxes = "XYZ", kRotary = "ABC";

std::string state_text(std::int64_t generation) {
  return generation > 0 ? "active, generation " + std::to_string(generation) : "not active";
}

std::string grid_text(const VolumetricTable& t) {
  std::string text;
  for (std::size_t k = 0; k < 3; ++k) {
    if (!t.machine.find(kAxes[k])) continue;
    const auto& commands = t.command_m[k];
    text += (text.empty() ? "" : ", ") + std::string(1, kAxes[k]) + " " + in_mm(commands.front());
    if (commands.size() > 1)
      text +=
          " to " + in_mm(commands.back()) + " (" + std::to_string(commands.size()) + " positions)";
  }
  const std::string rotary = rotary_text(t);
  return text + " mm" + (rotary.empty() ? "" : ", only at " + rotary);
}

struct Largest {
  double correction_m = 0, u_m = 0;
  std::size_t node = 0;
};

Largest largest_of(const VolumetricTable& t, std::size_t axis) {
  Largest largest;
  for (std::size_t node = 0; node < t.nodes(); ++node) {
    const double c = t.correction_m[node][axis];
    if (std::abs(c) > std::abs(largest.correction_m) || node == 0)
      largest = {c, t.u_m[node][axis], node};
  }
  return largest;
}

std::string names_text(const char* what, const std::vector<std::string>& names) {
  return names.empty() ? "" : wrapped(what + joined(names), terminal_columns()) + "\n";
}

std::string runs_text(const VolumetricTable& t) {
  std::vector<std::string> ids;
  for (const auto id : t.runs) ids.push_back(std::to_string(id));
  return joined(ids, " ");
}

}  // namespace

std::string volumetric_text(const VolumetricTable& t, std::int64_t generation) {
  TextTable out({"command of", "largest correction/µm", "u/µm", "u_common/µm", "u_independent/µm",
                 "at X/mm", "Y/mm", "Z/mm", "between nodes/µm"});
  for (std::size_t k = 0; k < 3; ++k) {
    if (!t.machine.find(kAxes[k])) continue;
    const Largest largest = largest_of(t, k);
    const Vec3 at = t.command_at(largest.node);
    out.add({std::string(1, kAxes[k]), um_to_place(largest.correction_m, largest.u_m),
             um_to_place(largest.u_m, largest.u_m),
             um_to_place(t.u_common_at(largest.node)[k], largest.u_m),
             um_to_place(t.u_independent_at(largest.node)[k], largest.u_m), in_mm(at[0]),
             in_mm(at[1]), in_mm(at[2]), fixed(to_um(t.interpolation_m[k]), 4)});
  }
  const std::string of = t.runs.empty() ? "" : ", from runs " + runs_text(t);
  return noise_only_notice(t.noise_only) + simulated_notice(t.simulated) +
         wrapped("table " + std::to_string(t.id) + ", volume of " + t.name + ", " +
                     state_text(generation) + of + ", " + t.created_utc,
                 terminal_columns()) +
         "\n" +
         wrapped("machine " + t.machine.text + " (" + chain_travels_text(t.machine) +
                     "), approach " + t.approach,
                 terminal_columns()) +
         "\n" + wrapped(std::to_string(t.nodes()) + " nodes: " + grid_text(t), terminal_columns()) +
         "\ncorrections, which are added to the commands\n" + out.text(terminal_columns()) +
         wrapped(
             "The column \"between nodes\" is the largest error of the linear interpolation. "
             "Largest residual that the linear axes cannot correct: " +
                 fixed(to_um(t.place_left_m), 4) + " µm (position), " +
                 fixed(to_urad(t.turn_left_rad), 2) + " µrad (angle)",
             terminal_columns()) +
         "\n" + names_text("not measured and not corrected: ", t.not_measured) +
         names_text("the grid extends beyond the error tables of: ", t.beyond_tables) +
         names_text("u does not include these errors: ", t.u_not_declared) +
         wrapped("u is the standard uncertainty. It contains " + covers_text(t),
                 terminal_columns()) +
         "\n" + "--csv and --json print all nodes\n";
}

std::string volumetric_csv(const VolumetricTable& t) {
  CsvText csv;
  csv.cells({"X_mm", "Y_mm", "Z_mm"});
  std::vector<std::string> rotary;  // the same for all nodes
  for (std::size_t k = 0; k < 3; ++k) {
    if (!t.machine.find(kRotary[k])) continue;
    csv.cell(std::string(1, kRotary[k]) + "_deg");
    rotary.push_back(plain_number(to_deg(t.rotary_rad[k]), 9));
  }
  csv.cells({"correction_X_um", "correction_Y_um", "correction_Z_um", "u_X_um", "u_Y_um", "u_Z_um",
             "u_common_X_um", "u_common_Y_um", "u_common_Z_um", "u_independent_X_um",
             "u_independent_Y_um", "u_independent_Z_um", "u_covers"});
  csv.end_row();
  const std::string covers = covers_text(t);
  for (std::size_t node = 0; node < t.nodes(); ++node) {
    for (const double x : t.command_at(node)) csv.cell(to_mm(x));
    for (const std::string& at : rotary) csv.cell(at);
    for (const double x : t.correction_m[node]) csv.cell(to_um(x) + 0.0);  // converts -0 to 0
    for (const Vec3& u : {t.u_m[node], t.u_common_at(node), t.u_independent_at(node)})
      for (const double x : u) csv.cell(to_um(x));
    csv.cell(covers).end_row();
  }
  return csv.take();
}

}  // namespace mdof::tools
