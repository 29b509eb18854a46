// Limits of the values and slopes of a table. No compensation of a miniaturised machine tool
// exceeds these limits. A table that exceeds them has a wrong unit or a wrong column, or its
// correction reverses the motion.
#pragma once

#include <string>
#include <vector>

#include "schema/base/result.h"
#include "schema/compensation_table.h"

namespace mdof::algo {

// Lengths in m and m/m, angles in rad and rad/m. The limits are far above intended corrections.
// They are far below the values that result if millimetres are read as micrometres.
struct TableLimits {
  double length_m = 1e-3, length_slope = 0.05;
  double angle_rad = 1e-2, angle_slope_rad_per_m = 0.5;

  // Returns limits from options. `um` is the limit of lengths in um and of angles in urad;
  // `um_per_mm` is the limit of slopes in um/mm and urad/mm. Null: the defaults above. Errors
  // (usage): a value that is not above 0; a value above 100 mm (100,000 um, urad); a slope above
  // 500 um/mm, which is half of the slope that reverses a motion.
  static Result<TableLimits> asked(const double* um, const double* um_per_mm);
};

// Checks one series of values at ascending positions; NaN: no value. The error (bad_input) states
// the series, the value or the slope, the limit, and the option that raises this limit.
Status check_limits(const std::string& name, bool angle, const std::vector<double>& position_m,
                    const std::vector<double>& values, const TableLimits& limits);
// Checks each error of a table for both approaches.
Status check_limits(const CompensationTable& table, const TableLimits& limits);

}  // namespace mdof::algo
