// Limits that no compensation of a miniaturised machine tool exceeds. They detect a wrong unit, a
// wrong column and a table whose correction reverses the motion.
#pragma once

#include <string>
#include <vector>

#include "schema/base/result.h"
#include "schema/compensation_table.h"

namespace mdof::algo {

// Lengths in m and m/m, angles in rad and rad/m. The limits are far above intended corrections and
// far below a millimetre that is read as a micrometre.
struct TableLimits {
  double length_m = 1e-3, length_slope = 0.05;
  double angle_rad = 1e-2, angle_slope_rad_per_m = 0.5;

  // Limits from options, for lengths and angles alike: um and urad, and per mm. Null: the defaults
  // above. Error (usage): not a number above 0, or above the limits of any table (100 mm; 500
  // um/mm, half of the slope that reverses a motion).
  static Result<TableLimits> asked(const double* um, const double* um_per_mm);
};

// Checks one series of values at ascending positions; NaN: no value. The error (bad_input) names
// the series, the value or the slope, the limit and the option that raises it.
Status check_limits(const std::string& name, bool angle, const std::vector<double>& position_m,
                    const std::vector<double>& values, const TableLimits& limits);
// Checks each error of a table, both approaches.
Status check_limits(const CompensationTable& table, const TableLimits& limits);

}  // namespace mdof::algo
