#include <algorithm>
#include <cmath>
#include <string>

#include "algo/form/clamping.h"
#include "algo/form/local_parabola.h"
#include "schema/base/number/number_text.h"
#include "schema/units.h"

namespace mdof::algo {
namespace {

constexpr double kLeastSquareShare = 0.5;  // share of the square that must be measured

double von_mises_Pa(const Parabola& c, const Plate& plate) {
  const double stiffness = plate.youngs_modulus_Pa * plate.thickness_m / 2;
  const double plane = stiffness / (1 - plate.poisson * plate.poisson);
  const double x = plane * (c.xx + plate.poisson * c.yy), y = plane * (c.yy + plate.poisson * c.xx);
  const double shear = stiffness / (1 + plate.poisson) * c.xy;
  return std::sqrt(x * x - x * y + y * y + 3 * shear * shear);
}

}  // namespace

Result<PlateStress> plate_stress(const SurfaceMap& form, const Plate& plate, double smooth_m) {
  const LocalParabola square(form, smooth_m, kLeastSquareShare);
  if (!square.is_large_enough())
    return fail(ErrorCode::usage,
                "the smoothing length of " + plain_number(to_mm(smooth_m)) +
                    " mm is less than two pixels (one pixel: " + plain_number(to_mm(form.dx_m)) +
                    " x " + plain_number(to_mm(form.dy_m)) +
                    " mm), but a curvature needs at least 3 x 3 pixels; give a larger length");
  PlateStress stress;
  for (std::size_t j = 0; j < form.ny; ++j)
    for (std::size_t i = 0; i < form.nx; ++i) {
      Parabola curvature;
      if (std::isnan(form.at(i, j)) || !square.at(i, j, curvature)) continue;
      ++stress.pixels;
      const double at_Pa = von_mises_Pa(curvature, plate);
      if (at_Pa <= stress.max_Pa) continue;
      stress.max_Pa = at_Pa;
      stress.x_m = form.x_m(i);
      stress.y_m = form.y_m(j);
    }
  if (stress.pixels > 0) return stress;
  return bad_input(form.name +
                   ": no pixel has enough measured pixels around it (at least half of the "
                   "smoothing square must be measured); give a smaller smoothing length");
}

}  // namespace mdof::algo
