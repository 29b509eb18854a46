#include "tools/mdof/commands/compensation/export_gate.h"

#include <algorithm>
#include <utility>

#include "daemon/measure/machine/volumetric.h"
#include "tools/mdof/commands/compensation/active_table.h"
#include "tools/mdof/stored/database.h"

namespace mdof::tools {

Status judge(const daemon::Judged& judged, const ExportRequest& request, ExportedTables& out) {
  MDOF_CHECK(daemon::check_gate(judged, request.consent, "it is not exported"));
  auto& marks = out.options.marks;
  for (auto& mark : daemon::warning_marks(judged)) marks.push_back(std::move(mark));
  out.simulated = out.simulated || judged.simulated;
  out.doubtful = out.doubtful || !judged.doubtful.empty();
  return {};
}

Status judge_active(std::int64_t table, std::int64_t generation, const ExportRequest& request,
                    std::vector<std::string>& marks) {
  if (generation > 0) return {};
  const std::string name = "table " + std::to_string(table);
  if (!request.not_active)
    return bad_input(name + " is not active; activate the table (mdof compensation activate " +
                     std::to_string(table) + place_options(request.database) +
                     "), or export the table with --not-active");
  marks.push_back("NOT ACTIVE: " + name + " was not active when it was exported");
  return {};
}

namespace {

// An active volumetric table also corrects positioning errors. If the controller read them from a
// file too, it would correct them twice.
Status judge_beside_volume(store::Store& store, const CompensationTable& table,
                           const ExportRequest& request, std::vector<std::string>& marks) {
  Status alone = daemon::check_no_volumetric(store);
  if (alone || alone.error().code != ErrorCode::conflict) return alone;
  const std::string name = "table " + std::to_string(table.id);
  if (!request.not_active)
    return fail(ErrorCode::conflict,
                name + ": " + alone.error().message + ". To export " + name +
                    " for a controller that does not apply the volumetric table, give --not-active",
                alone.error().remedy);
  marks.push_back("VOLUMETRIC TABLE ACTIVE: " + name +
                  " was exported while a volumetric table was active. If a controller applies both "
                  "tables, it corrects the positioning error twice");
  return {};
}

}  // namespace

Status judge_table(store::Store& store, const CompensationTable& table,
                   const ExportRequest& request, ExportedTables& out) {
  if (table.lacks_reference_point)
    return bad_input("table " + std::to_string(table.id) +
                     " does not name the point to which the errors refer; build the table again "
                     "from the same runs");
  MDOF_TRY(const daemon::Judged judged, daemon::judged_table(store, table));
  MDOF_CHECK(judge(judged, request, out));
  // A table with positioning errors is never active, because mdofd does not apply such tables.
  if (table.has_positioning()) return judge_beside_volume(store, table, request, out.options.marks);
  MDOF_TRY(const std::int64_t generation, generation_of(store, table));
  return judge_active(table.id, generation, request, out.options.marks);
}

Status judge_sign(const controllers::Format& format, const ExportRequest& request,
                  std::vector<std::string>& marks) {
  if (format.sign_confirmed) return {};
  const std::string why = std::string(format.sense) + " (" + format.source + ")";
  if (!request.unverified_sign)
    return fail(ErrorCode::usage, std::string("the correction sign of the format ") + format.name +
                                      " is not confirmed: " + why +
                                      ". A wrong sign doubles the error; verify the sign on the "
                                      "machine, then give --unverified-sign");
  marks.push_back("SIGN NOT CONFIRMED: verify on the machine that the error becomes smaller");
  return {};
}

Status judge_present(const std::vector<JointSettings::Correction>& corrections,
                     const std::vector<CompensationTable>& tables, const ExportRequest& request,
                     std::vector<std::string>& marks) {
  for (const auto& [axis, is_file, text] : corrections) {
    if (std::none_of(tables.begin(), tables.end(),
                     [axis = axis](const auto& table) { return letter(table.axis) == axis; }))
      continue;
    const std::string without = is_file ? "without a COMP_FILE" : "with BACKLASH = 0";
    const std::string why =
        request.ini + ": " + text +
        (is_file ? ", and the exported file replaces this file"
                 : ", but LinuxCNC ignores BACKLASH of a joint with a COMP_FILE") +
        ". The table is correct only if the axis was measured " + without;
    if (!request.consent.despite_warnings)
      return fail(ErrorCode::conflict,
                  why +
                      (is_file ? "; remove COMP_FILE from this file and measure again"
                               : "; measure with BACKLASH = 0 and set BACKLASH = 0 in this file") +
                      ". If the axis was measured in this way, give --despite-warnings");
    marks.push_back(std::string(is_file ? "COMP_FILE: " : "BACKLASH: ") + why);
  }
  return {};
}

}  // namespace mdof::tools
