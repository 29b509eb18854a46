// May a figure be made of these runs together?
#pragma once

#include <string>
#include <vector>

#include "schema/base/result.h"
#include "schema/notice/notice.h"
#include "schema/run.h"

namespace mdof::algo {

using Runs = std::vector<const Run*>;
Runs all_of(const std::vector<Run>& runs);

// Refuses a run that is not complete (a partial one is taken where `take_partial` asks for it),
// simulated runs beside measured ones, and readings that would count twice: the same run, the same
// recording, a run with the one that it goes on from, the same log in two files; their scatter
// would make the uncertainty too small. `what`: "a table".
Status check_usable(const Runs& runs, bool take_partial, const std::string& what);

// Why the readings of both are the same, as above; empty: they are not.
std::string readings_in_common(const Run& a, const Run& b);

// What is wrong with these runs is wrong with the figure, too: which are partial, and each notice
// of each run, with the run as its source.
Notices inherited_notices(const Runs& runs);

}  // namespace mdof::algo
