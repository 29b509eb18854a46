// JSON of runs, squareness and compensation tables. The command line and the RPC use the same JSON.
#pragma once

#include "schema/base/json_writer.h"
#include "schema/compensation_table.h"
#include "schema/iso230/squareness.h"
#include "schema/notice/notice.h"
#include "schema/notice/notice_json.h"
#include "schema/plausibility/plausibility_json.h"
#include "schema/run.h"
#include "schema/uncertainty/budget.h"
#include "schema/uncertainty/run_uncertainty.h"

namespace mdof {

// Writes {"target", "target_mm", "run", "direction", "position_mm", five errors, "u": {...},
// "u_random", "U", "k", "nu_eff", "residual_um", "samples", "flags"}. If the errors of the point
// could not be solved, they are null and there is a "reason".
void write_point(JsonWriter& json, const MovingAxis& moving, const MeasuredPoint& point,
                 const ErrorsUncertainty& uncertainty);

// False if the end of the run was not stored.
bool are_scans_known(const RunHeader& header);
// False if lost scans cannot be detected: the scans of a CSV log have no numbers, and an imported
// run has no scans. Also false if the number of scans is unknown.
bool is_lost_known(const RunHeader& header);

// Writes "key": ["text", ...] into an open object.
void write_strings(JsonWriter& json, const char* key, const std::vector<std::string>& texts);

// Writes "reference" and "reference_mm" (null for the carriage) into an open object.
void write_reference(JsonWriter& json, const StatedAt& at);
// As for runs. For positioning, null is written, because its reference is the measuring line, which
// an imported file does not state.
void write_reference(JsonWriter& json, const CompensationTable& table);

// Writes identity, state and provenance of the run, but not the points, into an open object.
void write_header_members(JsonWriter& json, const RunHeader& header, NoticeWords words);

// A run with its uncertainties and the figures that are stated with it.
struct RunMembers {
  const Run& run;
  const RunHeader& header;  // the header of `run`, or a shortened header
  const RunUncertainty& uncertainty;
  const StatedFigures& figures;  // for write_stated()
  bool with_points = true;
  std::size_t visit_limit = kAllVisits;  // for write_plausibility()
};
// Writes these members into an open object.
void write_run_members(JsonWriter& json, const RunMembers& members, NoticeWords words);

// Writes {"EYX_um": {"forward": {...}, "reverse": {...}, "mean": {...}}, ...}. "form_urad" states
// how well a line describes the axis. If `budgets` contains the budget of the slope, the slope in
// "mean" has the u of this budget.
void write_straightness(JsonWriter& json, const std::vector<StraightnessFigure>& figures,
                        const std::vector<Budget>& budgets = {});
// The budget of the least-squares slope of `figure`. nullptr: `budgets` does not contain it.
// Budgets exist only for the mean of both approaches.
const Budget* slope_budget(const std::vector<Budget>& budgets, const StraightnessFigure& figure);
void write_angles(JsonWriter& json, const std::vector<AngleFigure>& figures);

// Writes the members of a squareness into an open object. `budgets`: first the budget of EC0Y, then
// the budgets of the slopes.
void write_squareness_members(JsonWriter& json, const Squareness& squareness,
                              const std::vector<Budget>& budgets);

// Adds the member "notices" to a JSON object.
std::string with_notices(std::string json, const Notices& notices, NoticeWords words);

// Writes one position of the table: {"position_mm", "forward": {...}, "reverse": {...}}, each error
// with its "u".
void write_table_row(JsonWriter& json, const CompensationTable& table, std::size_t row);
// Writes the members that apply to the whole table into an open object.
void write_table_members(JsonWriter& json, const CompensationTable& table);
// The members of the table, and its "points".
std::string table_json(const CompensationTable& table);

}  // namespace mdof
