// Errors of an axis at its targets before and after an action on the axis, such as a compensation.
// Charts show these errors. Imported runs of positioning can be compared, too.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "schema/base/json_writer.h"
#include "schema/compensation_table.h"
#include "schema/run.h"

namespace mdof::daemon {

// Values and expanded uncertainties U, in m or rad. NaN: unknown.
struct ComparedValue {
  double before = 0, after = 0, U_before = 0, U_after = 0;
};
// forward, reverse: mean of the points with this approach. reversal: forward mean minus reverse
// mean.
inline constexpr std::array<const char*, 3> kComparedSides = {"forward", "reverse", "reversal"};
struct ComparedPoint {
  double position_m = 0;  // position of the target in the first run ("before")
  // side[i][k]: i is an index into kComparedSides, k is an index into ComparedPoints::errors.
  std::array<std::vector<ComparedValue>, kComparedSides.size()> side;
};
struct ComparedPoints {
  std::vector<std::string> errors;  // names of the errors, "EXX_um"
  std::vector<ComparedPoint> points;
};

// A run, and the compensation table that is calculated from this run alone.
struct TabledRun {
  const Run& run;
  const CompensationTable& table;
};

// Compares the targets that have the same position in both runs (within 0.1 mm). The coverage
// probability of U is 95 %. For imported readings, the coverage factor is from Student's t
// distribution, with the repeats at the target. For measured runs, k = 1.96. U of the reversal does
// not include the uncertainty that a run declares, because this uncertainty is common to both
// approaches.
ComparedPoints compared_points(const TabledRun& before, const TabledRun& after);

// Writes a member of an open object. Unknown values are null.
//   "points": [{"position_mm",
//               "forward": {"EXX_um": {"before", "after", "U_before", "U_after"}},
//               "reverse": {...}, "reversal": {...}}]
void write_compared_points(JsonWriter& json, const ComparedPoints& compared);

}  // namespace mdof::daemon
