#include "algo/part/part_error.h"

#include <algorithm>
#include <cmath>

#include "schema/base/random.h"

namespace mdof::algo {
namespace {

constexpr std::size_t kPointsPerTrial =
    1000;  // approximate number of points of the path in each trial

// Returns a normally distributed random number with variance 1 for a trial and a cause.
double drawn(std::uint64_t seed, std::size_t trial, std::size_t cause) {
  const Philox words =
      philox({{static_cast<std::uint32_t>(trial), 0, static_cast<std::uint32_t>(cause), 0}}, seed);
  return gaussian(uniform(words[0], words[1]));
}

// Returns the values of a cause at all points as one list: components along the normals, or all
// three components.
std::vector<double> seen(const PartPath& path, const std::vector<Eigen::Vector3d>& field) {
  std::vector<double> list;
  list.reserve(field.size() * (path.normal.empty() ? 3 : 1));
  for (std::size_t k = 0; k < field.size(); ++k) {
    if (!path.normal.empty()) {
      list.push_back(field[k].dot(path.normal[k]));
      continue;
    }
    for (Eigen::Index i = 0; i < 3; ++i) list.push_back(field[k](i));
  }
  return list;
}

double product(const std::vector<double>& a, const std::vector<double>& b, double points) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
  return sum / points;
}

struct Causes {
  std::vector<std::vector<double>> value, u;
  std::vector<bool> is_unknown;  // the cause has a u and no value
  // Mean products of two causes: value and value, value and u, u and u.
  Eigen::MatrixXd values, mixed, us;
};

Causes looked_at(const PartPath& path, const std::vector<PartCause>& causes) {
  Causes all;
  for (const PartCause& cause : causes) {
    all.value.push_back(seen(path, cause.value_m));
    all.u.push_back(seen(path, cause.u_m));
    all.is_unknown.push_back(std::all_of(all.value.back().begin(), all.value.back().end(),
                                         [](double x) { return x == 0; }));
  }
  const auto n = static_cast<Eigen::Index>(causes.size());
  const auto points = static_cast<double>(path.at_m.size());
  all.values = all.mixed = all.us = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index a = 0; a < n; ++a)
    for (Eigen::Index b = 0; b < n; ++b) {
      const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
      all.values(a, b) = product(all.value[i], all.value[j], points);
      all.mixed(a, b) = product(all.value[i], all.u[j], points);
      all.us(a, b) = product(all.u[i], all.u[j], points);
    }
  return all;
}

// Mean squares of the errors of layers and causes for given xi.
struct Squares {
  std::vector<double> layers, causes;
};

enum class UnknownCauses { expected, drawn };  // for causes with a known u and an unknown value

Squares squares_of(const std::vector<PartCause>& causes, const Causes& all,
                   const std::vector<double>& xi, std::size_t layers, UnknownCauses unknown) {
  Squares squares{std::vector<double>(layers), std::vector<double>(causes.size())};
  for (std::size_t i = 0; i < causes.size(); ++i)
    for (std::size_t j = 0; j < causes.size(); ++j) {
      if (causes[i].layer != causes[j].layer) continue;
      const auto a = static_cast<Eigen::Index>(i), b = static_cast<Eigen::Index>(j);
      double square = all.values(a, b) + xi[j] * all.mixed(a, b) + xi[i] * all.mixed(b, a) +
                      xi[i] * xi[j] * all.us(a, b);
      if (unknown == UnknownCauses::expected && (all.is_unknown[i] || all.is_unknown[j]))
        square = i == j ? all.us(a, a) : 0;
      squares.layers[causes[i].layer] += square;
      if (i == j) squares.causes[i] = square;
    }
  return squares;
}

double sum_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double x : values) sum += x;
  return sum;
}

double quantile_95(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto at = static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(values.size()));
  const auto k = std::min(at, static_cast<std::ptrdiff_t>(values.size()) - 1);
  std::nth_element(values.begin(), values.begin() + k, values.end());
  return values[static_cast<std::size_t>(k)];
}

void find_shares(const std::vector<PartCause>& causes, const Causes& all, std::size_t layers,
                 const PartTrials& trials, PartError& result) {
  std::vector<double> xi(causes.size());
  const Squares found = squares_of(causes, all, xi, layers, UnknownCauses::expected);
  const double whole = sum_of(found.layers), of_causes = sum_of(found.causes);
  const auto start = [](const std::vector<double>& squares, double sum,
                        std::vector<PartShare>& shares) {
    for (const double square : squares)
      shares.push_back({std::sqrt(std::max(0.0, square)), 0, sum > 0 ? square / sum : 0, 0});
  };
  start(found.layers, whole, result.layers);
  start(found.causes, of_causes, result.causes);
  std::vector<std::vector<double>> off(2 * (layers + causes.size()));
  for (std::size_t trial = 0; trial < trials.shares; ++trial) {
    for (std::size_t c = 0; c < causes.size(); ++c) xi[c] = drawn(trials.seed, trial, c);
    const Squares drawn_squares = squares_of(causes, all, xi, layers, UnknownCauses::drawn);
    std::size_t at = 0;
    const auto note = [&](const std::vector<double>& squares, std::vector<PartShare>& shares) {
      const double sum = sum_of(squares);
      for (std::size_t k = 0; k < shares.size(); ++k) {
        const double square = std::max(0.0, squares[k]);
        off[at++].push_back(std::abs((sum > 0 ? square / sum : 0) - shares[k].share));
        off[at++].push_back(std::abs(std::sqrt(square) - shares[k].rms_m));
      }
    };
    note(drawn_squares.layers, result.layers);
    note(drawn_squares.causes, result.causes);
  }
  std::size_t at = 0;
  for (auto* shares : {&result.layers, &result.causes})
    for (PartShare& share : *shares) {
      share.U_share = quantile_95(off[at++]);
      share.U_rms_m = quantile_95(off[at++]);
    }
}

// Returns the magnitude of the error at every `every`-th point.
std::vector<double> sizes(const PartPath& path, const Causes& all, const std::vector<double>& xi,
                          std::size_t every) {
  const std::size_t width = path.normal.empty() ? 3 : 1;
  std::vector<double> found;
  for (std::size_t k = 0; k < path.at_m.size(); k += every) {
    double square = 0;
    for (std::size_t i = 0; i < width; ++i) {
      double error = 0;
      for (std::size_t c = 0; c < xi.size(); ++c)
        error += all.value[c][k * width + i] + xi[c] * all.u[c][k * width + i];
      square += error * error;
    }
    found.push_back(std::sqrt(square));
  }
  return found;
}

// Returns the index of the point with the largest expected square of the error. The values of a
// budget are 0, so the error without random numbers has no largest point.
std::size_t worst_point(const Causes& all, const std::vector<double>& errors_m, std::size_t width) {
  std::size_t worst = 0;
  double most = -1;
  for (std::size_t k = 0; k < errors_m.size(); ++k) {
    double square = errors_m[k] * errors_m[k];
    for (const std::vector<double>& u : all.u)
      for (std::size_t i = k * width; i < (k + 1) * width; ++i) square += u[i] * u[i];
    if (square <= most) continue;
    most = square;
    worst = k;
  }
  return worst;
}

}  // namespace

PartError part_error(const PartPath& path, const std::vector<PartCause>& causes, std::size_t layers,
                     const PartTrials& trials) {
  PartError result;
  const Causes all = looked_at(path, causes);
  find_shares(causes, all, layers, trials, result);
  std::vector<double> xi(causes.size());
  const std::vector<double> found = sizes(path, all, xi, 1);
  result.worst = worst_point(all, found, path.normal.empty() ? 3 : 1);
  result.max_m = *std::max_element(found.begin(), found.end());
  result.p95_m = quantile_95(found);
  // The trials may use fewer points than the estimate. So they are compared with the error at the
  // same points without random numbers.
  const std::size_t every = std::max<std::size_t>(1, path.at_m.size() / kPointsPerTrial);
  const std::vector<double> thinned = sizes(path, all, xi, every);
  const double p95_m = quantile_95(thinned),
               max_m = *std::max_element(thinned.begin(), thinned.end());
  std::vector<double> drawn_p95, drawn_max;
  for (std::size_t trial = 0; trial < trials.errors; ++trial) {
    for (std::size_t c = 0; c < causes.size(); ++c) xi[c] = drawn(trials.seed, trial, c);
    const std::vector<double> drawn_sizes = sizes(path, all, xi, every);
    drawn_p95.push_back(quantile_95(drawn_sizes));
    drawn_max.push_back(*std::max_element(drawn_sizes.begin(), drawn_sizes.end()));
  }
  // A cause with a u and no value always increases the error, so the median of the trials is the
  // estimate.
  const auto take = [](std::vector<double> drawn, double thinned_m, double& estimate_m,
                       double& U_m) {
    if (drawn.empty()) return;
    std::nth_element(drawn.begin(), drawn.begin() + static_cast<std::ptrdiff_t>(drawn.size() / 2),
                     drawn.end());
    const double median_m = drawn[drawn.size() / 2];
    estimate_m += median_m - thinned_m;
    for (double& m : drawn) m = std::abs(m - median_m);
    U_m = quantile_95(std::move(drawn));
  };
  take(std::move(drawn_p95), p95_m, result.p95_m, result.U_p95_m);
  take(std::move(drawn_max), max_m, result.max_m, result.U_max_m);
  return result;
}

}  // namespace mdof::algo
