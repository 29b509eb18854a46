// Checks whether runs may be combined to one result.
#pragma once

#include <string>
#include <vector>

#include "schema/base/result.h"
#include "schema/notice/notice.h"
#include "schema/run.h"

namespace mdof::algo {

using Runs = std::vector<const Run*>;
Runs all_of(const std::vector<Run>& runs);

// `what`: the result in the text of the error, for example "a table". Errors:
// - a run that is not complete; with `take_partial` a partial run is accepted
// - simulated and measured runs together
// - readings that would be used twice, which would make the uncertainty too small: the same run,
//   the same recording, a run and the run that it continues, the same log in two files
Status check_usable(const Runs& runs, bool take_partial, const std::string& what);

// Returns the reason why two runs have readings in common; empty: they have no readings in common.
std::string readings_in_common(const Run& a, const Run& b);

// Returns the notices of the runs that also apply to the result: which runs are partial, and all
// notices of each run with the run as source.
Notices inherited_notices(const Runs& runs);

}  // namespace mdof::algo
