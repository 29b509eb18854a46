#include "daemon/measure/several_runs/change_at_targets.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "algo/iso230/line_fit.h"
#include "schema/sample.h"

namespace mdof::daemon {
namespace {

constexpr std::size_t kForward = 0, kReverse = 1, kReversal = 2;  // indices into kComparedSides

struct Changes {
  std::vector<double> x, y;  // x: positions, m; y: changes, m or rad
  void add(double at_m, double change) {
    if (!std::isfinite(change)) return;
    x.push_back(at_m);
    y.push_back(change);
  }
};

double change_of(const ComparedValue& value) {
  return value.after - value.before;
}

// Mean of the changes of both approaches. If one change is unknown, the result is the other change.
double mean_change(const ComparedPoint& point, std::size_t error) {
  const double forward = change_of(point.side[kForward][error]),
               reverse = change_of(point.side[kReverse][error]);
  if (std::isnan(forward)) return reverse;
  return std::isnan(reverse) ? forward : 0.5 * (forward + reverse);
}

Changes changes_of(const std::string& figure, const ComparedPoints& compared, std::size_t error) {
  Changes changes;
  const auto has = [&](const char* name) { return figure.find(name) != std::string::npos; };
  for (const ComparedPoint& point : compared.points) {
    const auto of = [&](std::size_t side) { return change_of(point.side[side][error]); };
    if (has("_B_")) {
      changes.add(point.position_m, of(kReversal));
    } else if (has("_E_")) {
      if (!has("_E_reverse_")) changes.add(point.position_m, of(kForward));
      if (!has("_E_forward_")) changes.add(point.position_m, of(kReverse));
    } else {
      changes.add(point.position_m, mean_change(point, error));
    }
  }
  return changes;
}

void subtract_fitted_line(Changes& changes) {
  if (!algo::can_fit(changes.x)) return;
  const algo::Line line = algo::least_squares_line(changes.x, changes.y);
  for (std::size_t i = 0; i < changes.x.size(); ++i) changes.y[i] -= line.at(changes.x[i]);
}

}  // namespace

double change_at_targets(const Budget& before, const Budget& after,
                         const ComparedPoints& compared) {
  const std::string& figure = before.figure;
  if (figure.find("_slope_") != std::string::npos) return std::abs(after.value - before.value);
  for (std::size_t error = 0; error < compared.errors.size(); ++error) {
    if (!figure.starts_with(compared.errors[error].substr(0, 3))) continue;
    Changes changes = changes_of(figure, compared, error);
    if (changes.y.empty()) return kNaN;
    if (figure.find("_straightness_") != std::string::npos) subtract_fitted_line(changes);
    const auto [least, most] = std::minmax_element(changes.y.begin(), changes.y.end());
    if (figure.find("_B_") != std::string::npos) return std::max(std::abs(*least), std::abs(*most));
    return *most - *least;
  }
  return kNaN;
}

}  // namespace mdof::daemon
