// Tables that are the sum of the residual errors of a compensated axis and of the table that the
// controller applied (algo/compensation/residuals/residuals.h).
#pragma once

#include "daemon/store/store.h"
#include "schema/base/result.h"
#include "schema/compensation_table.h"
#include "schema/notice/notice.h"

namespace mdof::daemon {

struct TableRequest;

// Reads the table `request.add_to`, and sets the slope and the reference point of the request to
// those of this table. Errors: during one of the runs, this table was not active or another table
// was active, too; the request states a slope or a reference point.
Result<CompensationTable> applied_table(store::Store& store, TableRequest& request);

// For a table that is such a sum: the notices of algo::residual_notices(), and a notice if the rigs
// of both tables differ. Empty for other tables.
Result<Notices> added_notices(store::Store& store, const CompensationTable& table);

// For a check run: the notices of algo::residual_notices() about the table that was active during
// the run. Empty if this table cannot be compared with the run: another table or none was active,
// the tables changed during the run, the table is volumetric, or the targets differ.
Result<Notices> check_run_notices(store::Store& store, std::int64_t run);

// The information which errors of a sum contain the values of the applied table, and which do not.
Notice statement_of_sum(const CompensationTable& table);

}  // namespace mdof::daemon
