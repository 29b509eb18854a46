#include "algo/milling/cutting_edge.h"

#include <algorithm>
#include <cmath>

namespace mdof::algo {
namespace {

constexpr double kWallAngles =
    // A trochoid can touch the wall up to this angle before φ = 0 or after φ = π.
    kHalfTurn_rad / 2;

}  // namespace

double wrapped_angle(double angle_rad) {
  const double a = std::fmod(angle_rad, kWholeTurn_rad);
  return a < 0 ? a + kWholeTurn_rad : a;
}

CuttingEdge::CuttingEdge(const MillingPlan& plan, int tooth, double height_m)
    : plan_(plan),
      lag_rad_(kWholeTurn_rad * tooth / plan.teeth +
               height_m * std::tan(plan.helix_rad) / plan.radius_m()),
      runout_m_(plan.runout_m + plan.runout_tilt * height_m),
      gamma_rad_(plan.runout_angle_rad + lag_rad_) {}

double CuttingEdge::angle(double turned_rad) const {
  return wrapped_angle(turned_rad - lag_rad_);
}
double CuttingEdge::turned(double angle_rad) const {
  return wrapped_angle(angle_rad + lag_rad_);
}

double CuttingEdge::x(double angle_rad) const {
  return plan_.radius_m() * std::sin(angle_rad) + runout_m_ * std::sin(angle_rad + gamma_rad_);
}
double CuttingEdge::y(double angle_rad) const {
  return plan_.radius_m() * std::cos(angle_rad) + runout_m_ * std::cos(angle_rad + gamma_rad_);
}

// Eq. 8 for any number of teeth Z: 1/π becomes Z/2π, and (-1)^z 2 r0 cos γ becomes the run-out of
// this tooth minus the run-out of the tooth before.
double CuttingEdge::eq8(double angle_rad, double feed, double& by_feed) const {
  const double s = std::sin(angle_rad), c = std::cos(angle_rad), r = plan_.radius_m();
  const double before = gamma_rad_ - kWholeTurn_rad / plan_.teeth,
               per_turn = plan_.teeth / (kWholeTurn_rad * r);
  const double along = 1 - per_turn * runout_m_ * (std::sin(gamma_rad_) - std::sin(before));
  const double square = c * c / (2 * r) - per_turn * s * c;
  by_feed = along * s + 2 * feed * square;
  return along * s * feed + square * feed * feed +
         runout_m_ * (std::cos(gamma_rad_) - std::cos(before));
}

// The thickness is the distance along the radius of the tooth from the tooth to the path of an
// earlier tooth. The smallest distance of all earlier teeth counts. When the tool is turned by
// `turned` (below 0: earlier), the tooth that is k teeth ahead is at the angle φ + 2π k / Z +
// turned.
Chip CuttingEdge::trochoid(double angle_rad) const {
  const double s = std::sin(angle_rad), c = std::cos(angle_rad);
  const double feed_per_rad = plan_.feed_per_tooth_m * plan_.teeth / kWholeTurn_rad;
  const double px = x(angle_rad), py = y(angle_rad);
  Chip least;
  least.thickness = INFINITY;
  for (int k = 1; k <= 2 * plan_.teeth; ++k) {
    const double ahead = kWholeTurn_rad * k / plan_.teeth;
    double turned = -ahead;
    double qx = 0, qy = 0;
    // Newton's method for the point of the path on this radius.
    for (int step = 0; step < 20; ++step) {
      const double a = angle_rad + ahead + turned, g = gamma_rad_ - ahead;
      const double r = plan_.radius_m();
      qx = feed_per_rad * turned + r * std::sin(a) + runout_m_ * std::sin(a + g);
      qy = r * std::cos(a) + runout_m_ * std::cos(a + g);
      const double across = qx * c - qy * s;
      const double slope = (feed_per_rad + r * std::cos(a) + runout_m_ * std::cos(a + g)) * c +
                           (r * std::sin(a) + runout_m_ * std::sin(a + g)) * s;
      const double move = (px * c - py * s - across) / slope;
      turned += move;
      if (std::abs(move) < 1e-14) break;
    }
    const double thickness = (px - qx) * s + (py - qy) * c;
    if (thickness < least.thickness) {
      least.thickness = thickness;
      least.earlier = k;
    }
  }
  return least;
}

Chip CuttingEdge::rigid_chip(double angle_rad) const {
  if (plan_.chip == ChipModel::trochoid) return trochoid(angle_rad);
  Chip chip;
  double by_feed = 0;
  if (plan_.chip == ChipModel::eq8) {
    chip.thickness = eq8(angle_rad, plan_.feed_per_tooth_m, by_feed);
  } else {
    const double before = gamma_rad_ - kWholeTurn_rad / plan_.teeth;
    chip.thickness = plan_.feed_per_tooth_m * std::sin(angle_rad) +
                     runout_m_ * (std::cos(gamma_rad_) - std::cos(before));
  }
  return chip;
}

Chip CuttingEdge::chip(double angle_rad, const Chip& rigid, const Deflection& now,
                       const Deflection& earlier) const {
  Chip chip = rigid;
  const double s = std::sin(angle_rad), c = std::cos(angle_rad);
  if (plan_.deflection == DeflectionModel::paper) {  // Eq. 9: feed minus deflection
    if (plan_.chip == ChipModel::eq8) {
      double by_feed = 0;
      chip.thickness = eq8(angle_rad, plan_.feed_per_tooth_m - now.x, by_feed);
      chip.by_x = -by_feed;
    } else {
      chip.thickness -= now.x * s;
      chip.by_x = -s;
    }
  } else if (plan_.deflection == DeflectionModel::steady) {
    chip.by_x = -s;
    chip.by_y = c;
    chip.by_earlier_x = s;
    chip.by_earlier_y = -c;
    chip.thickness += (earlier.x - now.x) * s + (now.y - earlier.y) * c;
  }
  return chip;
}

double CuttingEdge::free_side_angle(const Deflection& there) const {
  const double r = plan_.radius_m(), free = r - plan_.radial_depth_m;
  const double sign = plan_.is_up ? 1 : -1;
  const auto at = [&](double offset_y) {
    return std::acos(std::clamp((sign * free - offset_y) / r, -1.0, 1.0));
  };
  double edge = at(there.y);
  if (plan_.chip == ChipModel::trochoid)  // the position of the tooth includes the run-out
    for (int step = 0; step < 30; ++step)
      edge = at(there.y + runout_m_ * std::cos(edge + gamma_rad_));
  return edge;
}

double CuttingEdge::wall_side_angle() const {
  const double reach = plan_.chip == ChipModel::trochoid ? kWallAngles : 0;
  return plan_.is_up ? 0 - reach : kHalfTurn_rad + reach;  // 0 - 0 is +0
}

}  // namespace mdof::algo
