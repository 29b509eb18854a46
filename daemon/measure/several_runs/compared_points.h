// Errors of an axis target by target, before and after something was done to it: data for a
// picture; and the figures of positioning, which is all that most controllers correct.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "schema/base/json_writer.h"
#include "schema/compensation_table.h"
#include "schema/run.h"

namespace mdof::daemon {

// m or rad; NaN: not known.
struct ComparedValue {
  double before = 0, after = 0, U_before = 0, U_after = 0;
};
// forward, reverse: the mean of that approach; reversal: forward - reverse.
inline constexpr std::array<const char*, 3> kComparedSides = {"forward", "reverse", "reversal"};
struct ComparedPoint {
  double position_m = 0;                                               // of the run before
  std::array<std::vector<ComparedValue>, kComparedSides.size()> side;  // [.][error]
};
struct ComparedPoints {
  std::vector<std::string> errors;  // keys: "EXX_um"
  std::vector<ComparedPoint> points;
};

// A run and its own table.
struct TabledRun {
  const Run& run;
  const CompensationTable& table;
};

// At the targets that both have within 0.1 mm. U covers 95 %: of imported readings by Student's t
// of the repeats at the target, else with k = 1.96. What a run declares counts in both approaches
// alike, so that it is not in U of the reversal.
ComparedPoints compared_points(const TabledRun& before, const TabledRun& after);

// "points": [{"position_mm", "forward": {"EXX_um": {"before", "after", "U_before", "U_after"}},
// "reverse": {...}, "reversal": {...}}] of an open object; null: not known.
void write_compared_points(JsonWriter& json, const ComparedPoints& compared);

}  // namespace mdof::daemon
