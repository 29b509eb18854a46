#include "algo/compensation/table_limits.h"

#include <cmath>

#include "schema/base/number/number_text.h"
#include "schema/imported/series.h"
#include "schema/units.h"

namespace mdof::algo {
namespace {

constexpr double kAbsoluteLimit_um = 1e5, kAbsoluteSlopeLimit_um_per_mm = 500;

std::string mm_of(double position_m) {
  return plain_number(to_mm(position_m), 7) + " mm";
}

// Both functions convert to the units of the options: m to um, rad to urad, a slope per m to a
// slope per mm.
std::string value_text(double value, bool angle) {
  return plain_number(value * 1e6, 6) + (angle ? " urad" : " um");
}

std::string slope_text(double slope, bool angle) {
  return plain_number(slope * 1e3, 6) + (angle ? " urad/mm" : " um/mm");
}

Result<double> asked_number(const char* key, double x, double most, const char* unit) {
  if (x > 0 && x <= most) return x;
  return fail(ErrorCode::usage, std::string(key) + " must be above 0 and at most " +
                                    plain_number(most, 6) + " " + unit);
}

}  // namespace

Result<TableLimits> TableLimits::asked(const double* um, const double* um_per_mm) {
  TableLimits limits;
  if (um) {
    MDOF_TRY(const double x, asked_number("limit_um", *um, kAbsoluteLimit_um, "um"));
    limits.length_m = limits.angle_rad = x * 1e-6;
  }
  if (um_per_mm) {
    MDOF_TRY(const double x,
             asked_number("limit_um_per_mm", *um_per_mm, kAbsoluteSlopeLimit_um_per_mm, "um/mm"));
    limits.length_slope = limits.angle_slope_rad_per_m = x * 1e-3;
  }
  return limits;
}

Status check_limits(const std::string& name, bool angle, const std::vector<double>& position_m,
                    const std::vector<double>& values, const TableLimits& limits) {
  const double most = angle ? limits.angle_rad : limits.length_m;
  const double steepest = angle ? limits.angle_slope_rad_per_m : limits.length_slope;
  std::size_t before = values.size();
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isnan(values[i])) continue;
    if (!(std::abs(values[i]) <= most))
      return bad_input(name + ": " + value_text(values[i], angle) + " at " + mm_of(position_m[i]) +
                           " exceeds the limit of " + value_text(most, angle) +
                           "; check that the values are in " + (angle ? "urad" : "um"),
                       Remedy::raise_value_limit);
    if (before < values.size()) {
      const double slope = (values[i] - values[before]) / (position_m[i] - position_m[before]);
      if (!(std::abs(slope) <= steepest))
        return bad_input(name + ": changes by " + slope_text(slope, angle) + " from " +
                             mm_of(position_m[before]) + " to " + mm_of(position_m[i]) +
                             ", but the limit is " + slope_text(steepest, angle) +
                             "; check the units of values and positions",
                         Remedy::raise_slope_limit);
    }
    before = i;
  }
  return {};
}

Status check_limits(const CompensationTable& table, const TableLimits& limits) {
  const std::string of = (table.id == 0 ? "the table" : "table " + std::to_string(table.id)) + ", ";
  const auto both = [&](const std::string& error, bool angle, const std::vector<double>& forward,
                        const std::vector<double>& reverse) -> Status {
    MDOF_CHECK(check_limits(of + error + " forward", angle, table.position_m, forward, limits));
    return check_limits(of + error + " reverse", angle, table.position_m, reverse, limits);
  };
  for (std::size_t k = 0; k < kErrorCount; ++k) {
    const ErrorName& name = error_names(table.axis)[k];
    MDOF_CHECK(both(name.name, name.angle, table.forward[k], table.reverse[k]));
  }
  if (!table.has_positioning()) return {};
  return both(positioning_name(table.axis), false, table.positioning.forward,
              table.positioning.reverse);
}

}  // namespace mdof::algo
