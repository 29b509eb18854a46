// JSON of runs, squareness and compensation tables: the same for the command line and the RPC.
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

// {"target", "target_mm", "run", "direction", "position_mm", five errors, "u": {...}, "u_random",
// "U", "k", "nu_eff", "samples", "flags"}. An unsolved point has null errors and a "reason".
void write_point(JsonWriter& json, const MovingAxis& moving, const MeasuredPoint& point,
                 const ErrorsUncertainty& uncertainty);

// False if lost scans cannot be detected: the scans of a CSV log have no numbers, and an imported
// run has no scans.
bool is_lost_known(const RunHeader& header);

// Writes "key": ["text", ...] into an open object.
void write_strings(JsonWriter& json, const char* key, const std::vector<std::string>& texts);

// Writes "reference" and "reference_mm" (null for the carriage) into an open object.
void write_reference(JsonWriter& json, const StatedAt& at);
// Writes null for positioning: its reference is the measuring line, which an imported file does not
// state.
void write_reference(JsonWriter& json, const CompensationTable& table);

// Writes identity, state and provenance, without points, into an open object.
void write_header_members(JsonWriter& json, const RunHeader& header, NoticeWords words);

// A run with its uncertainties and stated figures.
struct RunMembers {
  const Run& run;
  const RunHeader& header;  // the header of `run` or a shortened one
  const RunUncertainty& uncertainty;
  const StatedFigures& figures;  // for write_stated()
  bool with_points = true;
  std::size_t visit_limit = kAllVisits;  // for write_plausibility()
};
// Writes the members into an open object.
void write_run_members(JsonWriter& json, const RunMembers& members, NoticeWords words);

// {"EYX_um": {"forward": {...}, "reverse": {...}, "mean": {...}}, ...}. "form_urad": how well a
// line describes the axis. The slope of "mean" has the u of its budget, if `budgets` holds it.
void write_straightness(JsonWriter& json, const std::vector<StraightnessFigure>& figures,
                        const std::vector<Budget>& budgets = {});
// The budget of the least-squares slope of `figure`. nullptr if `budgets` does not hold it; budgets
// exist for the mean of both approaches only.
const Budget* slope_budget(const std::vector<Budget>& budgets, const StraightnessFigure& figure);
void write_angles(JsonWriter& json, const std::vector<AngleFigure>& figures);

// Writes the members into an open object. `budgets`: EC0Y first, then the slopes.
void write_squareness_members(JsonWriter& json, const Squareness& squareness,
                              const std::vector<Budget>& budgets);

// Adds the member "notices" to a JSON object.
std::string with_notices(std::string json, const Notices& notices, NoticeWords words);

// One grid point: {"position_mm", "forward": {...}, "reverse": {...}}, errors with their "u".
void write_table_row(JsonWriter& json, const CompensationTable& table, std::size_t row);
// Writes the members that hold for the whole table into an open object.
void write_table_members(JsonWriter& json, const CompensationTable& table);
// The members of the table and its "points".
std::string table_json(const CompensationTable& table);

}  // namespace mdof
