// Reads the errors of a machine from runs, tables and squareness results of the database.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "daemon/store/store.h"
#include "schema/base/append_new.h"
#include "schema/base/result.h"
#include "schema/machine/machine.h"
#include "schema/notice/notice.h"

namespace mdof::daemon {

struct StoredErrors {
  std::vector<std::int64_t> runs;  // runs of the errors, including the runs of the tables
  Notices notices;                 // notices of the tables that were built
  Notices doubtful;                // the notices for which check_gate() rejects a table
};

// Reads the runs, tables and squareness results that the description of the machine names, and sets
// the errors of the machine.
//
// If the description names measured runs of an axis, the errors of this axis are the means of the
// runs, and the fixture is their reference point. If the description names a table, the reference
// point is the reference point of the table. The squareness uses the same reference points, so that
// the slope that is removed from a table is the slope that the squareness contains. holds_at_mm of
// an axis is the position of the reference point in the machine. The positioning of an axis is from
// its imported runs. These runs contain position errors in the coordinates of the controller. If
// the travel of the axis is "-", the error of the body has the opposite sign.
//
// Errors:
//   - a run, table or squareness is missing in the database;
//   - the axis, chain, travel or moving side of such a result differs from the description;
//   - the reference point of a table is the carriage or unknown;
//   - the description states the same error a second time;
//   - a table contains its straightness slope, and a squareness contains the same slope.
Result<StoredErrors> read_stored_errors(store::Store& store, Machine& machine);
// `notices`, followed by those of `doubtful` that are not among them.
inline Notices all_notices(const StoredErrors& stored) {
  Notices all = stored.notices;
  append_new(all, stored.doubtful);
  return all;
}

// Finds the squareness with this id. Without an id, finds the newest squareness of the axes
// `latest_of`. Error: not_found.
Result<Squareness> find_squareness(store::Store& store, std::optional<std::int64_t> id,
                                   AxisPair latest_of = {});

}  // namespace mdof::daemon
