// What keeps runs and their results from where only their numbers are seen: a controller, a rig.
// One rule for activation, export, import and separation: simulated and doubtful data pass when
// they are asked for, invalid data do not pass.
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

// What was asked for: --simulated, --despite-warnings.
struct Consent {
  bool simulated = false, despite_warnings = false;
};

enum class JudgedKind { run, table, squareness, separation, file };
struct Judged {
  JudgedKind kind = JudgedKind::table;
  std::string name;  // its number or file; empty: there is one alone
  bool simulated = false;
  Notices doubtful;  // doubtful and invalid ones
};

// Without the information among them.
Notices without_information(Notices notices);
// The same, and a missing datum is doubtful: a controller would apply the errors at another place.
Notices doubtful_notices(Notices notices);
// The same of the notices of these runs, and which are partial.
Notices doubtful_notices(const std::vector<Run>& runs);
// Which of these runs another one supersedes.
Result<Notices> superseded_notices(store::Store& store, const std::vector<std::int64_t>& runs);
// Of a stored table: what is doubtful of its runs, and what they show only together.
Result<Notices> doubtful_notices(store::Store& store, const CompensationTable& table);
Result<Judged> judged_table(store::Store& store, const CompensationTable& table);

// Any of its notices says that its numbers are wrong.
bool is_invalid(const RunHeader& run);
// By the one approach that the run has; "": by both, or by unknown ones.
const char* only_approach(const Run& run);
// Why no conformity is decided of its figures, without a full stop; empty: it can be. Invalid,
// incomplete, superseded, of one approach or with targets of one.
std::string against_decision(store::Store& store, const Run& run);

// `consequence`: "it is not activated". Error (conflict) with the first notice and what to ask
// with.
Status check_gate(const Judged& judged, const Consent& consent, const std::string& consequence);
// What a file of it says, one line each: SIMULATED, DOUBTFUL.
std::vector<std::string> marks_of(const Judged& judged,
                                  words::Language language = words::Language::english);
std::vector<std::string> marks_of(const Run& run,
                                  words::Language language = words::Language::english);

}  // namespace mdof::daemon
