// Protects readers that see only the numbers of a run or a result (a controller, a rig). The same
// rule holds for activation, export, import and separation: simulated and doubtful data pass only
// on request; invalid data never pass.
#pragma once

#include <string>
#include <vector>

#include "daemon/store/store.h"
#include "daemon/words/words.h"
#include "schema/base/result.h"
#include "schema/compensation_table.h"
#include "schema/notice/notice.h"
#include "schema/run.h"

namespace mdof::daemon {

// The requested exceptions: --simulated, --despite-warnings.
struct Consent {
  bool simulated = false, despite_warnings = false;
};

enum class JudgedKind { run, table, squareness, separation, file };
struct Judged {
  JudgedKind kind = JudgedKind::table;
  std::string name;  // its number or file; empty: it is the only one
  bool simulated = false;
  Notices doubtful;  // notices that are doubtful or invalid
};

// Removes notices that are information only.
Notices without_information(Notices notices);
// As without_information(). A missing datum becomes doubtful, because a controller would apply the
// errors at wrong positions.
Notices doubtful_notices(Notices notices);
// As above for the notices of these runs; partial runs are added.
Notices doubtful_notices(const std::vector<Run>& runs);
// Notices for those runs that another run supersedes.
Result<Notices> superseded_notices(store::Store& store, const std::vector<std::int64_t>& runs);
// For a stored table: doubtful notices of its runs, and those that only all runs together show.
Result<Notices> doubtful_notices(store::Store& store, const CompensationTable& table);
Result<Judged> judged_table(store::Store& store, const CompensationTable& table);

// Whether a notice states that the numbers of the run are wrong.
bool is_invalid(const RunHeader& run);
// The only approach of the run; "" if it has both approaches or unknown ones.
const char* only_approach(const Run& run);
// Why conformity of its figures cannot be decided, without a full stop; empty if it can. Reasons:
// the run is invalid, incomplete or superseded, has readings that never change (notice
// probes_dead), or a measured run lacks an approach at some targets.
std::string undecidable_reason(store::Store& store, const Run& run);

// `consequence`: "it is not activated". Error (conflict): states the first notice and the option
// that allows it.
Status check_gate(const Judged& judged, const Consent& consent, const std::string& consequence);
// Marks of a file, one line each: SIMULATED, DOUBTFUL.
std::vector<std::string> warning_marks(const Judged& judged,
                                       words::Language language = words::Language::english);
std::vector<std::string> warning_marks(const Run& run,
                                       words::Language language = words::Language::english);

}  // namespace mdof::daemon
