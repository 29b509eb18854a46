#include "tools/mdof/commands/machine/machine_runs.h"

#include <cmath>
#include <map>

#include "daemon/measure/evaluation.h"
#include "schema/imported/series.h"
#include "tools/mdof/output.h"
#include "tools/mdof/stored/database.h"
#include "tools/mdof/stored/run_choice.h"
#include "tools/mdof/text/notice_lines.h"

namespace mdof::tools {
namespace {

// One error of a table, without the positions at which it has no value.
ErrorFunction function_of(const std::vector<double>& position, const std::vector<double>& forward,
                          const std::vector<double>& reverse, const std::vector<double>& u) {
  ErrorFunction f;
  for (std::size_t i = 0; i < position.size(); ++i) {
    const bool has_forward = std::isfinite(forward[i]), has_reverse = std::isfinite(reverse[i]);
    if (!has_forward && !has_reverse) continue;
    f.position.push_back(position[i]);
    f.forward.push_back(has_forward ? forward[i] : reverse[i]);
    f.reverse.push_back(has_reverse ? reverse[i] : forward[i]);
    f.u.push_back(std::isfinite(u[i]) ? u[i] : 0);
  }
  return f;
}

Status take(MachineFrame& frame, std::size_t k, ErrorFunction function) {
  if (function.forward.empty()) return {};
  if (frame.error[k].known())
    return bad_input("--run: " + error_name(frame, k) + " is in MACHINE.toml too; give it once");
  MDOF_CHECK(check_function(function, k, "--run: " + error_name(frame, k)));
  frame.error[k] = std::move(function);
  return {};
}

Status take_table(Machine& machine, const CompensationTable& table) {
  const std::string axis(1, letter(table.axis));
  for (MachineFrame& frame : machine.frames) {
    if (frame.id != axis) continue;
    machine.simulated = machine.simulated || table.simulated;
    machine.noise_only = machine.noise_only || table.noise_only();
    if (table.has_positioning())
      return take(frame, frame.direction,
                  function_of(table.position_m, table.positioning.forward,
                              table.positioning.reverse, table.positioning.u_forward));
    for (std::size_t named = 0; named < 5; ++named) {
      std::vector<double> u;
      for (std::size_t row = 0; row < table.position_m.size(); ++row)
        u.push_back(table.u_of(table.u_forward, named, row));
      const std::string name = error_names(table.axis)[named].name;
      MDOF_CHECK(
          take(frame, std::string_view("XYZABC").find(name[1]),
               function_of(table.position_m, table.forward[named], table.reverse[named], u)));
    }
    return {};
  }
  return bad_input("--run: the chain " + machine.chain.text + " has no axis " + axis);
}

}  // namespace

Status add_runs(Machine& machine, const std::string& database,
                const std::vector<std::string>& runs) {
  if (runs.empty()) return {};
  MDOF_TRY(store::Store store, open_to_read(database));
  // Imported positioning and measured runs of one axis are tables of their own.
  std::map<std::pair<Axis, bool>, daemon::TableRequest> requests;
  for (const std::string& word : runs) {
    MDOF_TRY(const std::int64_t id, run_number(store, word));
    MDOF_TRY(const RunHeader header, store.run_header(id));
    requests[{header.axis, is_imported(header)}].runs.push_back(id);
  }
  for (const auto& [of, request] : requests) {
    MDOF_TRY(const auto built, daemon::calculate_table(store, request));
    show_notices(built.notices, true);
    MDOF_CHECK(take_table(machine, built.table));
  }
  return {};
}

}  // namespace mdof::tools
