#include "algo/compensation/between_targets.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "schema/sample.h"

namespace mdof::algo {
namespace {

constexpr double kRoughest = 4;
// Smallest number of values that has three second differences over two steps.
constexpr double kLeastRoughnessValues = 7;
constexpr double kFew = 5;  // with fewer values the scatter of the curvature is unknown
constexpr double kFewValuesRatio = 2;
// Weight of the mean square of all second differences; a nearby second difference has weight 1.
constexpr double kOverallWeight = 6;
// A second difference over a much shorter span than the interval may show only noise. Therefore the
// curvature is also calculated from the second differences over at least this share of the
// interval, and the larger curvature is used.
constexpr double kLeastSpanShare = 0.5;

struct Finite {
  std::vector<double> x, y, u;
};

Finite finite_of(const std::vector<double>& x, const std::vector<double>& y,
                 const std::vector<double>& u) {
  Finite finite;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!std::isfinite(y[i])) continue;
    finite.x.push_back(x[i]);
    finite.y.push_back(y[i]);
    finite.u.push_back(std::isfinite(u[i]) ? u[i] : 0);
  }
  return finite;
}

// Returns the square of the curvature at i from the values at i - step, i and i + step, minus the
// contribution of noise.
double square_at(const Finite& f, std::size_t i, std::size_t step) {
  const std::size_t before = i - step, behind = i + step;
  const double of_before = 2 / ((f.x[i] - f.x[before]) * (f.x[behind] - f.x[before]));
  const double of_behind = 2 / ((f.x[behind] - f.x[i]) * (f.x[behind] - f.x[before]));
  const double of_middle = of_before + of_behind;
  const double curvature = of_before * f.y[before] - of_middle * f.y[i] + of_behind * f.y[behind];
  const double noise = std::pow(of_before * f.u[before], 2) + std::pow(of_middle * f.u[i], 2) +
                       std::pow(of_behind * f.u[behind], 2);
  return curvature * curvature - noise;
}

double span(const Finite& f, std::size_t i, std::size_t step) {
  return f.x[i + step] - f.x[i - step];
}

struct SquareSum {
  double sum = 0, count = 0;
  double mean() const { return count > 0 ? std::max(0.0, sum / count) : 0; }
};

// Sums the squares at the positions first ... last that have at least `step` values on both sides.
// The distance of these values is at least `least_span`.
SquareSum squares(const Finite& f, std::size_t first, std::size_t last, std::size_t step,
                  double least_span) {
  SquareSum all;
  for (std::size_t i = std::max(first, step); i <= last && i + step < f.x.size(); ++i) {
    if (span(f, i, step) < least_span) continue;
    all.sum += square_at(f, i, step);
    all.count += 1;
  }
  return all;
}

// The second differences over at least `least_span`.
struct Roughness {
  double ratio = 0;       // R: the curvature at half a step / the curvature at one step
  double everywhere = 0;  // mean square of the curvature
};

Roughness roughness(const Finite& f, double least_span) {
  const SquareSum one = squares(f, 0, f.x.size() - 1, 1, least_span);
  const double values = one.count + 2;
  if (values < kLeastRoughnessValues)
    return {values < kFew ? kRoughest : kFewValuesRatio, one.mean()};
  const double two = squares(f, 0, f.x.size() - 1, 2, least_span).mean();
  const double q = two > 0 ? std::clamp(std::sqrt(one.mean() / two), 1.0, kRoughest) : kRoughest;
  return {std::max(2 * std::sqrt(q) / (1 + std::sqrt(q)), q * q / kRoughest), one.mean()};
}

double shortest_span(const Finite& f) {
  double shortest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i + 1 < f.x.size(); ++i) shortest = std::min(shortest, span(f, i, 1));
  return shortest;
}

}  // namespace

std::vector<double> curvatures(const std::vector<double>& position_m,
                               const std::vector<double>& values, const std::vector<double>& u) {
  std::vector<double> all(std::max<std::size_t>(position_m.size(), 1) - 1, kNaN);
  const Finite f = finite_of(position_m, values, u);
  if (f.x.size() < 3) return all;
  const Roughness of_all = roughness(f, 0);
  const double shortest = shortest_span(f);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto above = std::upper_bound(f.x.begin(), f.x.end(), position_m[i]) - f.x.begin();
    const auto right = static_cast<std::size_t>(std::max<std::ptrdiff_t>(above, 1));
    const auto curvature = [&](const Roughness& rough, double least_span) {
      const SquareSum near = squares(f, right < 2 ? 0 : right - 2, right + 1, 1, least_span);
      return rough.ratio * std::sqrt(std::max(0.0, kOverallWeight * rough.everywhere + near.sum) /
                                     (kOverallWeight + near.count));
    };
    all[i] = curvature(of_all, 0);
    const std::size_t end = std::min(right, f.x.size() - 1);
    const double least_span = kLeastSpanShare * (f.x[end] - f.x[end - 1]);
    if (least_span > shortest)
      all[i] = std::max(all[i], curvature(roughness(f, least_span), least_span));
  }
  return all;
}

double u_beyond_end(double distance, double interval, double change, double curvature) {
  const double bent = 0.5 * distance * (interval + distance) * curvature;
  return std::hypot(distance * change / interval, std::isfinite(bent) ? bent : 0);
}

void add_curvatures(CompensationTable& table) {
  for (std::size_t k = 0; k < kErrorCount; ++k) {
    table.curvature_forward[k] = curvatures(table.position_m, table.forward[k], table.u_forward[k]);
    table.curvature_reverse[k] = curvatures(table.position_m, table.reverse[k], table.u_reverse[k]);
  }
}

}  // namespace mdof::algo
