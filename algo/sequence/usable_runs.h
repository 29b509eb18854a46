// Whether runs may be combined to one result.
#pragma once

#include <string>
#include <vector>

#include "schema/base/result.h"
#include "schema/notice/notice.h"
#include "schema/run.h"

namespace mdof::algo {

using Runs = std::vector<const Run*>;
Runs all_of(const std::vector<Run>& runs);

// Errors: a run that is not complete (a partial run is accepted with `take_partial`); simulated
// together with measured runs; readings that would count twice (the same run, the same recording, a
// run and the run that it continues, the same log in two files), because their scatter would make
// the uncertainty too small. `what`: "a table".
Status check_usable(const Runs& runs, bool take_partial, const std::string& what);

// Why both have the same readings, as above; empty: they do not.
std::string readings_in_common(const Run& a, const Run& b);

// Notices of the runs that hold for the result, too: which runs are partial, and each notice of
// each run, with the run as its source.
Notices inherited_notices(const Runs& runs);

}  // namespace mdof::algo
