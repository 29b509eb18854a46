// Checks data before they are used in a controller or in a rig, where nobody reads the notices of
// the data. Activation, export, import and separation use the same rule. Simulated data and
// doubtful data are accepted only if the user requests it. Invalid data are always rejected.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "daemon/store/store.h"
#include "daemon/words/words.h"
#include "schema/base/result.h"
#include "schema/compensation_table.h"
#include "schema/notice/notice.h"
#include "schema/run.h"

namespace mdof::daemon {

// The data that the user accepts with the options --simulated and --despite-warnings.
struct Consent {
  bool simulated = false, despite_warnings = false;
};

enum class JudgedKind { run, table, squareness, separation, file };
struct Judged {
  JudgedKind kind = JudgedKind::table;
  std::string name;  // number of the run or result, or name of the file; empty for a separation
  bool simulated = false;
  Notices doubtful;  // notices with the severity doubtful or invalid
};

// Removes the notices with the severity "information".
Notices without_information(Notices notices);
// As without_information(). Before that, the notices of a missing datum and of a lost position get
// the severity "doubtful", because a controller would apply the errors at wrong positions.
Notices doubtful_notices(Notices notices);
// As above, for the notices of all these runs. A partial run also gets a notice.
Notices doubtful_notices(const std::vector<Run>& runs);
// The tables that a controller may have applied while this run, and the runs that it continues,
// were recorded: the tables that were active then. Volumetric tables with one correction for the
// whole axis are left out. Empty if the run has neither a recording nor a CSV log.
Result<store::TablesOfRun> applied_tables(store::Store& store, std::int64_t run);
// The notices of a result from these runs: one for each run that another run supersedes, and one
// for each table of applied_tables(). If the controller applied such a table, the run contains
// only the errors that remained, and a table from this run must not replace the active table. There
// is no notice for the table `added_to`, because the result contains its values.
Result<Notices> source_run_notices(store::Store& store, const std::vector<std::int64_t>& runs,
                                   std::optional<std::int64_t> added_to = std::nullopt);
// Notices about a result from several runs of an axis: visits or rigs differ. `runs`: at least one.
Result<Notices> differences_of_runs(const std::vector<Run>& runs);
// For a stored table: the doubtful notices of each run, and the notices that compare the runs.
Result<Notices> doubtful_notices(store::Store& store, const CompensationTable& table);
Result<Judged> judged_table(store::Store& store, const CompensationTable& table);

// Whether a notice states that the numbers of the run are wrong.
bool is_invalid(const RunHeader& run);
// "forward" or "reverse" if all points of the run have this approach; otherwise "".
const char* only_approach(const Run& run);
// Why the errors of the run may be wrong: the texts and codes of its notices with the severity
// invalid or doubtful, without a full stop at the end. Empty: the run has no such notice.
std::string doubt_reason(const Run& run);
// The reason why the conformity of the figures of the run cannot be decided. Empty if the
// conformity can be decided. The text has no full stop at its end. Possible reasons:
//   - the run is invalid, incomplete or superseded;
//   - a measured run has only one approach;
//   - the run is doubtful. No notice limits its effect on a figure, so "not conform" is not decided
//     either.
std::string undecidable_reason(store::Store& store, const Run& run);

// `consequence`: text for the message, "it is not activated". Error (conflict): the data are
// rejected. The message states the first notice and the option that accepts such data.
Status check_gate(const Judged& judged, const Consent& consent, const std::string& consequence);
// The warnings at the beginning of an exported file. Each is one line that begins with SIMULATED or
// DOUBTFUL.
std::vector<std::string> warning_marks(const Judged& judged,
                                       words::Language language = words::Language::english);
std::vector<std::string> warning_marks(const Run& run,
                                       words::Language language = words::Language::english);

}  // namespace mdof::daemon
