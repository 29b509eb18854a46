#include "algo/compensation/thinning.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "schema/base/number/number_text.h"

namespace mdof::algo {
namespace {

using Columns = std::vector<std::vector<double>>;

Status check_input(const std::vector<double>& x, const Columns& columns, double tolerance) {
  if (x.size() < 2) return bad_input("a table needs at least two points");
  if (!(tolerance >= 0 && std::isfinite(tolerance)))
    return bad_input("the tolerance must be a finite number and not negative");
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!std::isfinite(x[i]))
      return bad_input("position " + std::to_string(i + 1) + " is not a finite number");
    if (i > 0 && !(x[i] > x[i - 1]))
      return bad_input("position " + std::to_string(i + 1) +
                       " is not greater than the position before");
  }
  for (const auto& y : columns) {
    if (y.size() != x.size())
      return bad_input("the number of positions differs from the number of values");
    for (std::size_t i = 0; i < y.size(); ++i)
      if (!std::isfinite(y[i]))
        return bad_input("position " + std::to_string(i + 1) + " has no value");
  }
  return {};
}

// Range of the slopes of the lines that begin at one point and pass all points added so far within
// the tolerance.
struct Cone {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
};

// The cones of all columns, which begin at the point `from`. Each later point narrows the cones.
class Fan {
 public:
  Fan(const std::vector<double>& x, const Columns& columns, std::size_t from, double tolerance)
      : x_(x), columns_(columns), from_(from), tolerance_(tolerance), cones_(columns.size()) {}

  bool reaches(std::size_t to) const {
    for (std::size_t c = 0; c < cones_.size(); ++c) {
      const double slope = (columns_[c][to] - columns_[c][from_]) / (x_[to] - x_[from_]);
      if (slope < cones_[c].low || slope > cones_[c].high) return false;
    }
    return true;
  }
  // Adds a point that the lines must pass; false: no line passes all points.
  bool narrow(std::size_t by) {
    const double dx = x_[by] - x_[from_];
    for (std::size_t c = 0; c < cones_.size(); ++c) {
      const double dy = columns_[c][by] - columns_[c][from_];
      cones_[c].low = std::max(cones_[c].low, (dy - tolerance_) / dx);
      cones_[c].high = std::min(cones_[c].high, (dy + tolerance_) / dx);
      if (cones_[c].low > cones_[c].high) return false;
    }
    return true;
  }

 private:
  const std::vector<double>& x_;
  const Columns& columns_;
  std::size_t from_;
  double tolerance_;
  std::vector<Cone> cones_;
};

// Returns the smallest set of points from the first to the last point. If several sets have the
// same size, it returns the set with the earlier points.
std::vector<std::size_t> fewest(const std::vector<double>& x, const Columns& columns,
                                double tolerance) {
  const std::size_t n = x.size();
  std::vector<std::size_t> steps(n, n), before(n, 0);
  steps[0] = 0;
  for (std::size_t from = 0; from + 1 < n; ++from) {
    Fan fan(x, columns, from, tolerance);
    for (std::size_t to = from + 1; to < n; ++to) {
      if (steps[from] + 1 < steps[to] && fan.reaches(to)) {
        steps[to] = steps[from] + 1;
        before[to] = from;
      }
      if (!fan.narrow(to)) break;
    }
  }
  std::vector<std::size_t> way{n - 1};
  while (way.back() != 0) way.push_back(before[way.back()]);
  std::reverse(way.begin(), way.end());
  return way;
}

double deviation_of(const std::vector<double>& x, const Columns& columns,
                    const std::vector<std::size_t>& kept) {
  double largest = 0;
  for (std::size_t k = 1; k < kept.size(); ++k)
    for (std::size_t i = kept[k - 1] + 1; i < kept[k]; ++i) {
      const std::size_t a = kept[k - 1], b = kept[k];
      const double share = (x[i] - x[a]) / (x[b] - x[a]);
      for (const auto& y : columns)
        largest = std::max(largest, std::abs(y[a] + (y[b] - y[a]) * share - y[i]));
    }
  return largest;
}

}  // namespace

Result<Thinned> thinned(const std::vector<double>& x, const Columns& columns, double tolerance) {
  MDOF_CHECK(check_input(x, columns, tolerance));
  Thinned out;
  if (tolerance > 0) {
    out.kept = fewest(x, columns, tolerance);
    out.largest_deviation = deviation_of(x, columns, out.kept);
    return out;
  }
  for (std::size_t i = 0; i < x.size(); ++i) out.kept.push_back(i);
  return out;
}

Result<double> tolerance_for(const std::vector<double>& x, const Columns& columns,
                             std::size_t most) {
  MDOF_CHECK(check_input(x, columns, 0));
  if (most < 2) return bad_input("a table needs at least two points, so fewer cannot be requested");
  if (x.size() <= most) return 0.0;
  double high = 0;
  for (const auto& y : columns) {
    const auto [least, greatest] = std::minmax_element(y.begin(), y.end());
    high = std::max(high, *greatest - *least);
  }
  double low = 0;
  while (high > 0 && high - low > 0.01 * high && high > 1e-15) {
    const double middle = 0.5 * (low + high);
    (fewest(x, columns, middle).size() <= most ? high : low) = middle;
  }
  return high;
}

}  // namespace mdof::algo
