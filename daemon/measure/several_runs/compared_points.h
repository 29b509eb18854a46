// Errors of an axis at its targets before and after an action on the axis, for charts. Runs of
// positioning are included, because most controllers correct only positioning.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "schema/base/json_writer.h"
#include "schema/compensation_table.h"
#include "schema/run.h"

namespace mdof::daemon {

// In m or rad; NaN: unknown.
struct ComparedValue {
  double before = 0, after = 0, U_before = 0, U_after = 0;
};
// forward, reverse: mean of this approach; reversal: forward - reverse.
inline constexpr std::array<const char*, 3> kComparedSides = {"forward", "reverse", "reversal"};
struct ComparedPoint {
  double position_m = 0;  // position of the target in the run before
  std::array<std::vector<ComparedValue>, kComparedSides.size()> side;  // [side][error]
};
struct ComparedPoints {
  std::vector<std::string> errors;  // keys: "EXX_um"
  std::vector<ComparedPoint> points;
};

// A run and the table of this run alone.
struct TabledRun {
  const Run& run;
  const CompensationTable& table;
};

// Compares the targets that both runs have within 0.1 mm. U covers 95 %: for imported readings by
// Student's t from the repeats at the target, otherwise with k = 1.96. The uncertainty that a run
// declares is common to both approaches, so that U of the reversal does not include it.
ComparedPoints compared_points(const TabledRun& before, const TabledRun& after);

// Member of an open object: "points": [{"position_mm", "forward": {"EXX_um": {"before", "after",
// "U_before", "U_after"}}, "reverse": {...}, "reversal": {...}}]; null: unknown.
void write_compared_points(JsonWriter& json, const ComparedPoints& compared);

}  // namespace mdof::daemon
