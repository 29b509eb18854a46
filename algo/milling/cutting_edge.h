// Positions of the teeth of an end mill and thickness of their chips (README.md has the equations).
// x is along the feed, y towards the wall of an up cut; a tooth at the angle φ is at r (sin φ, cos
// φ) from the axis. m, rad.
#pragma once

#include <numbers>

#include "schema/milling/milling_plan.h"

namespace mdof::algo {

inline constexpr double kHalfTurn_rad = std::numbers::pi;
inline constexpr double kWholeTurn_rad = 2 * kHalfTurn_rad;

// Deflection of the tool at a height: against the feed and towards the wall of an up cut, m.
struct Deflection {
  double x = 0, y = 0;
};

// A chip, and its derivatives by the present deflection and by the deflection at the tooth that
// left its surface.
struct Chip {
  double thickness = 0;
  double by_x = 0, by_y = 0;  // derivatives by the present deflection
  // Derivatives by the deflection `earlier` teeth before.
  double by_earlier_x = 0, by_earlier_y = 0;
  int earlier = 1;
};

// One tooth at one height.
class CuttingEdge {
 public:
  CuttingEdge(const MillingPlan& plan, int tooth, double height_m);

  // φ when tooth 0 has turned to `turned_rad` at the tip, in [0, 2π).
  double angle(double turned_rad) const;
  double turned(double angle_rad) const;  // the inverse, in [0, 2π)

  // Chip of the rigid tool, by the model of the plan; below 0: the tooth does not reach the work.
  Chip rigid_chip(double angle_rad) const;
  // The chip with the effect of the deflection, by the deflection model of the plan.
  Chip chip(double angle_rad, const Chip& rigid, const Deflection& now,
            const Deflection& earlier) const;

  // φ at which the tooth leaves (up) or enters (down) the work, for this deflection. Eq. 5, 6, 10
  // and 11 with corrected signs.
  double free_edge(const Deflection& there) const;
  // φ at which the tooth enters (up) or leaves (down) at the wall.
  double wall_edge() const;

  // Its position relative to the spindle axis.
  double x(double angle_rad) const;
  double y(double angle_rad) const;

 private:
  double eq8(double angle_rad, double feed, double& by_feed) const;
  Chip trochoid(double angle_rad) const;

  const MillingPlan& plan_;
  double lag_rad_;               // angle behind tooth 0 at the tip
  double runout_m_, gamma_rad_;  // magnitude, and angle ahead of this edge
};

// Wraps an angle to [0, 2π).
double wrapped_angle(double angle_rad);

}  // namespace mdof::algo
