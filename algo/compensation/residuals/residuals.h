// Adds the residual errors of a compensated axis to the table that the controller applied.
//
// The errors of the axis are E. While the controller applies the table T, a check run measures the
// residuals R = E - T + m, where m are the errors of this measurement. The new table is T + R = E +
// m. T is an exactly known number here, whatever the errors of its own measurement are. Therefore u
// of the new table is u of R. An error with a declared uncertainty, such as the flatness, is in T
// and, with the opposite sign, in E - T, so it cancels. It remains once, in m.
#pragma once

#include "schema/base/result.h"
#include "schema/compensation_table.h"
#include "schema/notice/notice.h"

namespace mdof::algo {

// Adds the values of `applied` at the targets of `table`, for each approach. Between its targets,
// `applied` is interpolated as by table_at(). An error that the controller cannot correct (no axis
// of the chain corrects it) remains as measured. Errors: the tables have different axes, sides,
// chains, reference points or approaches; no error can be corrected; `table` lacks a target of
// `applied`, or has a target beyond it.
Status add_applied(const CompensationTable& applied, CompensationTable& table);

// Notices if the residuals in `table` (a result of add_applied()) are similar to `applied`. The sum
// is then wrong: the controller probably did not apply this table, applied it with the wrong sign,
// or did not apply it for each approach. `earlier`: the table to which the errors in `applied` were
// added; null: no such table. With `earlier`, the residuals are also compared with the added
// errors. Otherwise a controller that never applies a table would not be detected after several
// additions: the residuals are then 1, 1/2, 1/3 … of the growing sum.
Notices residual_notices(const CompensationTable& applied, const CompensationTable* earlier,
                         const CompensationTable& table);

}  // namespace mdof::algo
