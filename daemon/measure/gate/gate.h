// What keeps runs, and what is made of them, from where only their numbers are seen: a controller,
// a rig. One rule for activation, export, import and separation: simulated data and doubts pass
// when they are asked for, what is invalid does not pass.
#pragma once

#include <string>
#include <vector>

#include "daemon/store/store.h"
#include "schema/base/result.h"
#include "schema/compensation_table.h"
#include "schema/run.h"

namespace mdof::daemon {

// What was asked for: --simulated, --despite-warnings.
struct Consent {
  bool simulated = false, despite_warnings = false;
};

struct Judged {
  std::string what;  // "table 3"
  bool simulated = false;
  std::vector<std::string> doubts;  // doubtful and invalid sentences
};

// Without the information among them.
std::vector<std::string> doubts_among(std::vector<std::string> sentences);
// Of encoders without datum: errors are right against each other, but at another place.
std::vector<std::string> datum_doubts(const std::vector<Run>& runs);
// The same, warnings of these runs, and which are partial.
std::vector<std::string> doubts_of(const std::vector<Run>& runs);
// The same of a stored table's runs, and what they show only together.
Result<std::vector<std::string>> doubts_of_table(store::Store& store,
                                                 const CompensationTable& table);
Result<Judged> judged_table(store::Store& store, const CompensationTable& table);

// `consequence`: "it is not activated". Error (conflict) with the first doubt and what to ask with.
Status check_gate(const Judged& judged, const Consent& consent, const std::string& consequence);
// What a file of it says, one line each: SIMULATED, DOUBTFUL.
std::vector<std::string> marks_of(const Judged& judged);
std::vector<std::string> marks_of(const Run& run);

}  // namespace mdof::daemon
