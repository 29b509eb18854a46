// The JSON of runs, squareness and compensation tables: one form for the command line and the RPC.
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
//  "U", "k", "nu_eff", "samples", "flags"}; an unsolved point has null errors and its "reason".
void write_point(JsonWriter& json, const MovingAxis& moving, const MeasuredPoint& point,
                 const ErrorsUncertainty& uncertainty);

// The scans of a CSV log are not numbered, and an imported run has none: nobody knows of one that
// it is missing.
bool lost_is_known(const RunHeader& header);

// "key": ["text", ...] of an open object.
void write_strings(JsonWriter& json, const char* key, const std::vector<std::string>& texts);

// "reference" and "reference_mm" (null for the carriage) of an open object.
void write_reference(JsonWriter& json, const StatedAt& at);
// null for positioning: its place is the measuring line, which an imported file does not say.
void write_reference(JsonWriter& json, const CompensationTable& table);

// Identity, state and provenance, without points; the members of an open object.
void write_header_members(JsonWriter& json, const RunHeader& header, NoticeWords words);

// A run with what is stated of it.
struct RunMembers {
  const Run& run;
  const RunHeader& header;  // the run's, or a shorter one
  const RunUncertainty& uncertainty;
  const StatedFigures& figures;  // as of write_stated()
  bool with_points = true;
  std::size_t most_visits = kAllVisits;  // of write_plausibility()
};
// The members of an open object.
void write_run_members(JsonWriter& json, const RunMembers& members, NoticeWords words);

// {"EYX_um": {"forward": {...}, "reverse": {...}, "mean": {...}}, ...}. "form_urad": how well a
// line describes the axis. The slope of the mean has the u of its budget, where it is among these.
void write_straightness(JsonWriter& json, const std::vector<StraightnessFigure>& figures,
                        const std::vector<Budget>& budgets = {});
// The budget of its slope by least squares; none: it is not among them, which have those of the
// mean of both approaches.
const Budget* budget_of_slope(const std::vector<Budget>& budgets, const StraightnessFigure& figure);
void write_angles(JsonWriter& json, const std::vector<AngleFigure>& figures);

// Members of an open object; `budgets`: of EC0Y, then of the slopes.
void write_squareness_members(JsonWriter& json, const Squareness& squareness,
                              const std::vector<Budget>& budgets);

// A JSON object with one member more: "notices".
std::string with_notices(std::string json, const Notices& notices, NoticeWords words);

// One grid point: {"position_mm", "forward": {...}, "reverse": {...}}: errors, with "u" inside.
void write_table_row(JsonWriter& json, const CompensationTable& table, std::size_t row);
// What holds for the whole table; the members of an open object.
void write_table_members(JsonWriter& json, const CompensationTable& table);
// Its members and "points".
std::string table_json(const CompensationTable& table);

}  // namespace mdof
