#include "daemon/measure/gate/added_table.h"

#include <optional>
#include <string>

#include "algo/compensation/residuals/residuals.h"
#include "daemon/measure/evaluation.h"
#include "daemon/measure/gate/gate.h"
#include "schema/rig/correction.h"
#include "schema/rig/report_facts.h"

namespace mdof::daemon {
namespace {

// Error: during one of the runs, this table was not active or another table was active, too.
Status check_applied(store::Store& store, std::int64_t table,
                     const std::vector<std::int64_t>& runs) {
  const std::string of = "table " + std::to_string(table);
  for (const std::int64_t id : runs) {
    MDOF_TRY(const RunHeader run, store.run_header(id));
    const std::string name = "run " + std::to_string(id);
    if (!run.start_known)
      return bad_input(name +
                       ": the time of the measurement is unknown, so it is unknown whether " + of +
                       " was active; state the start of the measurement in the log (# started: "
                       "2026-11-20T10:11:12Z), and replay the log");
    MDOF_TRY(const auto active, applied_tables(store, id));
    if (active.tables == std::vector{table} && active.changed)
      return bad_input(name + ": " + of +
                       " was not active during the whole run, because a table was activated or "
                       "deactivated meanwhile; activate only " +
                       of + ", and measure the axis again");
    if (active.tables == std::vector{table}) continue;
    std::string names;
    for (const std::int64_t other : active.tables)
      names += (names.empty() ? "table " : " and table ") + std::to_string(other);
    return bad_input(name + ": the errors of this run are not the residual errors of " + of +
                     ", because it was not the only active table (active during the run: " +
                     (names.empty() ? "no table" : names) + "); activate only " + of +
                     ", and measure the axis again");
  }
  return {};
}

}  // namespace

Result<CompensationTable> applied_table(store::Store& store, TableRequest& request) {
  MDOF_TRY(CompensationTable applied, store.table(*request.add_to));
  if (request.keep_slope || request.reference)
    return fail(ErrorCode::usage,
                "table " + std::to_string(applied.id) +
                    " determines the slope and the reference point of the new table (add_to); "
                    "leave out keep_slope and reference");
  MDOF_CHECK(check_applied(store, applied.id, request.runs));
  request.keep_slope = !applied.slope_removed;
  request.reference = applied.stated.reference;
  return applied;
}

Result<Notices> added_notices(store::Store& store, const CompensationTable& table) {
  if (!table.added_to) return Notices();
  MDOF_TRY(const CompensationTable applied, store.table(*table.added_to));
  std::optional<CompensationTable> earlier;
  if (applied.added_to) {
    MDOF_TRY(earlier, store.table(*applied.added_to));
  }
  Notices found = algo::residual_notices(applied, earlier ? &*earlier : nullptr, table);
  MDOF_TRY(const RunHeader before, store.run_header(applied.runs.front()));
  MDOF_TRY(const RunHeader after, store.run_header(table.runs.front()));
  if (result_content(before.provenance.rig_text) != result_content(after.provenance.rig_text))
    found.push_back(notice(NoticeCode::rigs_differ));
  return found;
}

Result<Notices> check_run_notices(store::Store& store, std::int64_t run) {
  MDOF_TRY(const auto active, applied_tables(store, run));
  if (active.tables.size() != 1 || active.changed) return Notices();
  TableRequest request;
  request.runs = {run};
  request.partial = true;
  request.add_to = active.tables.front();
  const auto sum = calculate_table(store, request);
  return sum ? added_notices(store, sum->table) : Notices();
}

Notice statement_of_sum(const CompensationTable& table) {
  const CorrectionSigns signs =
      correction_signs(table.machine, table.axis, table.sides, table.stated.reference);
  std::string added, others;
  for (std::size_t k = 0; k < signs.factor.size(); ++k) {
    std::string& list = signs.factor[k] != 0 ? added : others;
    list += (list.empty() ? "" : ", ") + std::string(error_names(table.axis)[k].name);
  }
  return notice(
      NoticeCode::residuals_added, "",
      {{"table", *table.added_to}, {"errors", added}, {"others", others.empty() ? "-" : others}});
}

}  // namespace mdof::daemon
