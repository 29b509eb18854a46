// What no compensation of a miniaturized machine tool is: a number in another unit, a wrong column,
// a table whose correction turns the motion round.
#pragma once

#include <string>
#include <vector>

#include "schema/base/result.h"
#include "schema/compensation_table.h"

namespace mdof::algo {

// Of a length in m and m/m, of an angle in rad and rad/m. Far beyond what is corrected on purpose,
// far below a millimetre taken for a micrometre.
struct TableLimits {
  double length_m = 1e-3, length_slope = 0.05;
  double angle_rad = 1e-2, angle_slope_rad_per_m = 0.5;

  // As they are asked for, of lengths and angles alike: um and urad, and by mm. Not given: as
  // above. Error (usage): beyond what any table can be (100 mm; 500 um/mm, half of what turns a
  // motion round), or no number above 0.
  static Result<TableLimits> asked(const double* um, const double* um_per_mm);
};

// One series: values at positions that ascend; NaN: none there. Error (bad_input): `name`, the
// value or the slope, the limit, and the option that raises it.
Status check_limits(const std::string& name, bool angle, const std::vector<double>& position_m,
                    const std::vector<double>& values, const TableLimits& limits);
// Each error of a table, both approaches.
Status check_limits(const CompensationTable& table, const TableLimits& limits);

}  // namespace mdof::algo
