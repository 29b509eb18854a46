// Calculates the positions of the teeth of an end mill and the thickness of their chips (README.md
// has the equations). x is along the feed; y is towards the wall of an up cut. A tooth at the angle
// φ is at r (sin φ, cos φ) from the tool axis. m, rad.
#pragma once

#include <numbers>

#include "schema/milling/milling_plan.h"

namespace mdof::algo {

inline constexpr double kHalfTurn_rad = std::numbers::pi;
inline constexpr double kWholeTurn_rad = 2 * kHalfTurn_rad;

// Deflection of the tool at a height, m. x: against the feed; y: towards the wall of an up cut.
struct Deflection {
  double x = 0, y = 0;
};

// Thickness of a chip and its derivatives. The outer surface of the chip was cut by an earlier
// tooth, so the thickness depends on the present deflection and on the deflection at that time.
struct Chip {
  double thickness = 0;
  double by_x = 0, by_y = 0;  // derivatives by the present deflection
  // Derivatives by the deflection when the tooth that is `earlier` teeth ahead cut the surface.
  double by_earlier_x = 0, by_earlier_y = 0;
  int earlier = 1;
};

// One tooth at one height above the tip.
class CuttingEdge {
 public:
  CuttingEdge(const MillingPlan& plan, int tooth, double height_m);

  // Returns φ of this tooth, in [0, 2π), if tooth 0 is at the angle `turned_rad` at the tip.
  double angle(double turned_rad) const;
  double turned(double angle_rad) const;  // the inverse of angle(), in [0, 2π)

  // Returns the chip of a rigid tool with the chip model of the plan. Thickness below 0: the tooth
  // does not touch the workpiece.
  Chip rigid_chip(double angle_rad) const;
  // Returns the chip including the effect of the deflection, with the deflection model of the plan.
  Chip chip(double angle_rad, const Chip& rigid, const Deflection& now,
            const Deflection& earlier) const;

  // Returns the angle φ at which the tooth leaves the workpiece (up cut) or enters it (down cut)
  // with this deflection. Eq. 5, 6, 10 and 11 with corrected signs.
  double free_side_angle(const Deflection& there) const;
  // Returns the angle φ at the wall, at which the tooth enters (up cut) or leaves (down cut) the
  // workpiece.
  double wall_side_angle() const;

  // Position of the tooth relative to the spindle axis.
  double x(double angle_rad) const;
  double y(double angle_rad) const;

 private:
  double eq8(double angle_rad, double feed, double& by_feed) const;
  Chip trochoid(double angle_rad) const;

  const MillingPlan& plan_;
  double lag_rad_;  // angle by which the tooth is behind tooth 0 at the tip
  // Magnitude of the run-out; angle by which the run-out is ahead of this edge.
  double runout_m_, gamma_rad_;
};

// Wraps an angle to [0, 2π).
double wrapped_angle(double angle_rad);

}  // namespace mdof::algo
