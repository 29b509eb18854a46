#include "tools/mdof/text/compensation_text.h"

#include <cmath>

#include "schema/imported/series.h"
#include "schema/rig/correction.h"
#include "tools/mdof/terminal.h"
#include "tools/mdof/text/run_tables.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

using Columns = std::array<std::vector<double>, 5>;

// The text of a table that contains only positioning errors.
std::string positioning_text(const CompensationTable& t, bool is_forward) {
  const auto& values = is_forward ? t.positioning.forward : t.positioning.reverse;
  TextTable out({"position/mm", error_label(positioning_name(t.axis) + "_um")});
  std::vector<double> all;
  for (std::size_t i = 0; i < t.position_m.size(); ++i)
    all.push_back(t.positioning_u_at(is_forward, i));
  for (std::size_t i = 0; i < t.position_m.size(); ++i)
    out.add({in_mm(t.position_m[i]), um_with_u(values[i], all[i], column_u(all))});
  return out.text(terminal_columns());
}

std::string side_text(const CompensationTable& t, const Columns& values, const Columns& u) {
  std::vector<std::string> head{"position/mm"};
  for (const auto& name : error_names(t.axis)) head.push_back(error_label(name.key));
  TextTable out(std::move(head));
  std::array<double, 5> column{};
  for (std::size_t k = 0; k < 5; ++k) {
    std::vector<double> all;
    for (std::size_t i = 0; i < t.position_m.size(); ++i) all.push_back(t.u_of(u, k, i));
    column[k] = column_u(all);
  }
  for (std::size_t i = 0; i < t.position_m.size(); ++i) {
    std::vector<std::string> row{in_mm(t.position_m[i])};
    for (std::size_t k = 0; k < 5; ++k) {
      const auto show = error_names(t.axis)[k].angle ? urad_with_u : um_with_u;
      row.push_back(show(values[k][i], t.u_of(u, k, i), column[k]));
    }
    out.add(std::move(row));
  }
  return out.text(terminal_columns());
}

std::string numbers_of(const std::vector<std::int64_t>& runs) {
  std::vector<std::string> ids;
  for (const auto id : runs) ids.push_back(std::to_string(id));
  return joined(ids, " ");
}

std::string runs_of(const std::vector<std::int64_t>& runs) {
  return (runs.size() == 1 ? "run " : "runs ") + numbers_of(runs);
}

std::string corrections_text(const CompensationTable& t, std::size_t width) {
  if (t.has_positioning())
    return std::string(1, letter(t.axis)) + " command: add -" + positioning_name(t.axis) +
           "; this is the same for a moving tool and a moving table\n";
  const CorrectionSigns signs = correction_signs(t.machine, t.axis, t.sides, t.stated.reference);
  if (!t.machine.known()) return wrapped("correction: unknown; " + signs.gap[0], width, 2) + "\n";
  std::string text = "machine " + t.machine.text + " (" + chain_travels_text(t.machine) + ")\n";
  for (std::size_t k = 0; k < 5; ++k) {
    const ErrorName& name = error_names(t.axis)[k];
    text += signs.factor[k] == 0
                ? "no correction of " + std::string(name.name) + ": " + signs.gap[k]
                : std::string(1, corrected_by(name)) + " command: add " +
                      (signs.factor[k] > 0 ? "+" : "-") + name.name;
    text += "\n";
  }
  return fitted(text, width);
}

std::string state_of(std::int64_t generation) {
  return generation > 0 ? "active, generation " + std::to_string(generation) : "not active";
}

}  // namespace

std::string table_of_positioning_text(const CompensationTable& t) {
  return simulated_notice(t.simulated) +
         wrapped("table " + std::to_string(t.id) + ", axis " + letter(t.axis) +
                     ", positioning errors from the imported " + runs_of(t.runs) + ", " +
                     t.created_utc,
                 terminal_columns()) +
         "\n" +
         wrapped(positioning_name(t.axis) +
                     " = actual minus commanded position, positive in the + direction of the "
                     "controller coordinates (positioning_sense: " +
                     to_string(kTablePositioningSense) + ")",
                 terminal_columns()) +
         "\n" + corrections_text(t, terminal_columns()) + "\nforward\n" +
         positioning_text(t, true) + "\nreverse\n" + positioning_text(t, false) +
         wrapped("± is the standard uncertainty u. It contains " + covers_text(t),
                 terminal_columns()) +
         "\n";
}

std::string table_text(const CompensationTable& t, std::int64_t generation) {
  if (t.has_positioning()) return table_of_positioning_text(t);
  return noise_only_notice(t.noise_only()) + simulated_notice(t.simulated) +
         wrapped(
             "table " + std::to_string(t.id) + ", axis " + letter(t.axis) + ", " +
                 state_of(generation) + ", created " + t.created_utc + ", from " + runs_of(t.runs) +
                 (t.added_to ? ", whose errors were added to table " + std::to_string(*t.added_to)
                             : ""),
             terminal_columns()) +
         "\n"
         "error = actual - nominal position of the moving " +
         t.sides.moves() + "\nstraightness " +
         (t.slope_removed ? "about the least-squares line" : "as measured") +
         ", angles relative to the first target\n" + stated_text(t.stated) +
         corrections_text(t, terminal_columns()) + "\nforward\n" +
         side_text(t, t.forward, t.u_forward) + "\nreverse\n" +
         side_text(t, t.reverse, t.u_reverse) +
         wrapped("± is the standard uncertainty u. It contains " + covers_text(t) +
                     (t.not_declared.empty() ? "" : "; not declared: " + joined(t.not_declared)),
                 terminal_columns()) +
         "\n";
}

std::string list_text(const daemon::ListedTables& list) {
  TextTable out(
      {"table", "axis", "state", "data", "runs", "points", "from/mm", "to/mm", "created"});
  for (std::size_t i = 0; i < list.tables.size(); ++i) {
    const auto& t = list.tables[i];
    out.add({std::to_string(t.id), std::string(1, letter(t.axis)), state_of(list.generations[i]),
             t.simulated ? "SIMULATED" : "measured", numbers_of(t.runs),
             std::to_string(t.position_m.size()), in_mm(t.position_m.front()),
             in_mm(t.position_m.back()), t.created_utc});
  }
  for (std::size_t i = 0; i < list.volumes.size(); ++i) {
    const auto& t = list.volumes[i];
    out.add({std::to_string(t.id), "volume", state_of(list.volume_generations[i]),
             t.simulated ? "SIMULATED" : "measured", numbers_of(t.runs), std::to_string(t.nodes()),
             "", "", t.created_utc});
  }
  return out.text(terminal_columns());
}

}  // namespace mdof::tools
