// Uses runs, tables and squareness of the database as the measured errors of a machine.
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
  std::vector<std::int64_t> runs;  // source runs of the errors, also through tables
  Notices notices;                 // notices of the tables that were built
  Notices doubtful;                // those notices that prevent the use by a controller
};

// Reads the runs, tables and squareness that the description names into its errors.
//
// Measured runs of an axis give their mean, stated at the fixture. The squareness is stated there,
// too: the slope that is removed from a table is then the slope in the squareness. The errors hold
// at the point holds_at_mm of the axis. Imported runs of the axis give its positioning. They
// contain the error of the position in the controller's coordinates; the error of the body has the
// sign of the axis' travel.
//
// Errors: a missing row; a row of another axis, chain, travel or moving side than in the
// description; an error that the description gives, too; a table that keeps its straightness slope
// although a squareness contains it, or that has another reference point than the squareness.
Result<StoredErrors> read_stored_errors(store::Store& store, Machine& machine);

// The squareness with this id; without an id the newest of the two axes. Error: not_found.
Result<Squareness> find_squareness(store::Store& store, std::optional<std::int64_t> id,
                                   AxisPair latest_of = {});

}  // namespace mdof::daemon
