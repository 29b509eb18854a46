// Runs, tables and the squareness of the database as the measured errors of a machine.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "daemon/store/store.h"
#include "schema/base/result.h"
#include "schema/machine/machine.h"
#include "schema/notice/notice.h"

namespace mdof::daemon {

struct StoredErrors {
  std::vector<std::int64_t> runs;  // that the errors come from, through tables as well
  Notices notices;                 // of the tables that were built
  Notices doubtful;                // what of all of them keeps a controller from them
};

// Takes what the description names (runs, tables, squareness) into its errors.
//
// Measured runs of an axis give their mean, stated at the fixture: there the squareness is stated,
// too, so that the slope that a table has lost is the one that the squareness has. It holds at
// holds_at_mm of the axis. Imported runs of the axis give its positioning: what they hold is the
// place in the controller's coordinates, whose error is the body's with the sign of the axis'
// travel.
//
// Errors: a row that is not there, of another axis, of another chain, travel or moving side than
// the description says; an error that the description has too; a table whose straightness has its
// slope beside a squareness that has it again, or that is stated elsewhere than the squareness.
Result<StoredErrors> take_stored_errors(store::Store& store, Machine& machine);

// The squareness of this number; without one the newest of two axes. Error: not_found.
Result<Squareness> find_squareness(store::Store& store, std::optional<std::int64_t> id,
                                   AxisPair latest_of = {});

}  // namespace mdof::daemon
