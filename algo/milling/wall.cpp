#include "algo/milling/wall.h"

#include <algorithm>
#include <cmath>

namespace mdof::algo {
namespace {

// Returns the largest angle of a tooth from the direction of the wall at which the tooth can still
// cut the wall. The angle also covers teeth of neighbouring turns, at a distance of up to four
// feeds per turn.
double wall_range_rad(const MillingPlan& plan) {
  return std::min(1.2, 0.05 + 4 * plan.feed_per_tooth_m * plan.teeth / plan.radius_m());
}

class Line {
 public:
  Line(const MillingPlan& plan, double height_m)
      : period_m_(plan.feed_per_tooth_m * plan.teeth),
        cells_(static_cast<std::size_t>(std::ceil(period_m_ / plan.wall_grid_m))),
        step_m_(period_m_ / static_cast<double>(cells_)) {
    line.height_m = height_m;
    line.outward_m.assign(cells_, -INFINITY);
  }

  // Cuts all cells along the straight line between two positions of a tooth.
  void cut(double x0, double y0, double x1, double y1) {
    if (x1 < x0) {
      std::swap(x0, x1);
      std::swap(y0, y1);
    }
    for (double k = std::ceil(x0 / step_m_); k * step_m_ <= x1; ++k) {
      const double part = x1 > x0 ? (k * step_m_ - x0) / (x1 - x0) : 0;
      const double n = static_cast<double>(cells_);
      double& cell = line.outward_m[static_cast<std::size_t>(k - n * std::floor(k / n))];
      cell = std::max(cell, y0 + (y1 - y0) * part);
    }
  }

  WallLine line;

 private:
  double period_m_;
  std::size_t cells_;
  double step_m_;
};

WallLine wall_line(const MillingPlan& plan, const CutTurn& turn, double height_m) {
  Eigen::MatrixXd u = deflection_m(plan, turn, height_m);
  if (plan.deflection == DeflectionModel::rigid) u.setZero();
  const double feed_per_rad = plan.feed_per_tooth_m * plan.teeth / kWholeTurn_rad;
  const double wall_at = plan.is_up ? 0 : kWholeTurn_rad / 2, range = wall_range_rad(plan);
  const std::size_t steps = turn.turned_rad.size();
  Line line(plan, height_m);
  for (int j = 0; j < plan.teeth; ++j) {
    const CuttingEdge edge(plan, j, height_m);
    const auto place = [&](std::size_t n) {
      const double a = edge.angle(turn.turned_rad[n]);
      const auto row = static_cast<Eigen::Index>(n);
      const double outward = edge.y(a) + u(row, 1);
      return std::pair(feed_per_rad * turn.turned_rad[n] + edge.x(a) - u(row, 0),
                       (plan.is_up ? outward : -outward) - plan.radius_m());
    };
    for (std::size_t n = 0; n < steps; ++n) {
      const double from_wall =
          wrapped_angle(edge.angle(turn.turned_rad[n]) - wall_at + kWholeTurn_rad / 2) -
          kWholeTurn_rad / 2;
      if (std::abs(from_wall) > range) continue;
      const auto [x0, y0] = place(n);
      auto [x1, y1] = place((n + 1) % steps);
      if (n + 1 == steps) x1 += feed_per_rad * kWholeTurn_rad;  // this position is in the next turn
      line.cut(x0, y0, x1, y1);
    }
  }
  return line.line;
}

}  // namespace

double WallLine::mean_m() const {
  double sum = 0;
  for (const double y : outward_m) sum += y;
  return sum / static_cast<double>(outward_m.size());
}

double WallLine::waviness_m() const {
  const auto [least, most] = std::minmax_element(outward_m.begin(), outward_m.end());
  return *most - *least;
}

double WallLine::Ra_m() const {
  const double mean = mean_m();
  double sum = 0;
  for (const double y : outward_m) sum += std::abs(y - mean);
  return sum / static_cast<double>(outward_m.size());
}

std::vector<WallLine> wall_lines(const MillingPlan& plan, const CutTurn& turn) {
  std::vector<WallLine> lines = {wall_line(plan, turn, 0)};
  for (const double height_m : turn.height_m) lines.push_back(wall_line(plan, turn, height_m));
  lines.push_back(wall_line(plan, turn, plan.axial_depth_m));
  return lines;
}

}  // namespace mdof::algo
