#include "algo/part/part_error.h"

#include <algorithm>
#include <cmath>

#include "schema/base/random.h"

namespace mdof::algo {
namespace {

constexpr std::size_t kPointsPerTrial =
    1000;  // approximate number of points of the path in each trial

// Returns normally distributed random numbers with variance 1 for a trial.
std::vector<double> drawn(std::uint64_t seed, std::size_t trial, std::size_t count) {
  std::vector<double> xi;
  for (std::size_t q = 0; q < count; ++q) {
    const Philox words =
        philox({{static_cast<std::uint32_t>(trial), 0, static_cast<std::uint32_t>(q), 0}}, seed);
    xi.push_back(gaussian(uniform(words[0], words[1])));
  }
  return xi;
}

// Returns a field at all points as one list: components along the normals, or all
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

// The effect of one standard uncertainty at all points. `xi`: index of its random number.
struct Effect {
  std::size_t xi = 0;
  std::vector<double> u;
};

// The error of one cause, of the causes of a layer, or of all causes.
struct Sum {
  std::vector<double> value;
  std::vector<Effect> effects;  // one for each xi
};

void add(const std::vector<double>& from, std::vector<double>& to) {
  if (to.empty()) to.resize(from.size());
  for (std::size_t k = 0; k < from.size(); ++k) to[k] += from[k];
}

void add(const Sum& from, Sum& to) {
  add(from.value, to.value);
  for (const Effect& effect : from.effects) {
    const auto same = std::find_if(to.effects.begin(), to.effects.end(),
                                   [&](const Effect& e) { return e.xi == effect.xi; });
    if (same == to.effects.end())
      to.effects.push_back(effect);
    else
      add(effect.u, same->u);
  }
}

// Cause c has the random number c. The common parts have the numbers after the causes.
Sum sum_of_cause(const PartPath& path, const std::vector<PartCause>& causes, std::size_t c) {
  Sum sum{seen(path, causes[c].value_m), {{c, seen(path, causes[c].u_m)}}};
  for (const CommonPart& part : causes[c].common)
    sum.effects.push_back({causes.size() + part.number, seen(path, part.u_m)});
  return sum;
}

bool is_unknown(const Sum& cause) {
  return std::all_of(cause.value.begin(), cause.value.end(), [](double x) { return x == 0; });
}

// The mean square error of a sum over the points, as a function of the random numbers.
class MeanSquare {
 public:
  // `unknown`: the part of the sum with a known u and an unknown value.
  MeanSquare(const Sum& sum, const Sum& unknown, double points)
      : expected_(product(sum.value, sum.value, points)) {
    const auto n = static_cast<Eigen::Index>(sum.effects.size());
    for (const Effect& effect : unknown.effects) expected_ += product(effect.u, effect.u, points);
    value_ = product(sum.value, sum.value, points);
    mixed_ = Eigen::VectorXd(n);
    squares_ = Eigen::MatrixXd(n, n);
    for (Eigen::Index a = 0; a < n; ++a) {
      const Effect& effect = sum.effects[static_cast<std::size_t>(a)];
      xi_.push_back(effect.xi);
      mixed_(a) = product(sum.value, effect.u, points);
      for (Eigen::Index b = 0; b <= a; ++b)
        squares_(a, b) = squares_(b, a) =
            product(effect.u, sum.effects[static_cast<std::size_t>(b)].u, points);
    }
  }

  // With the expected squares of the unknown causes, without other random errors.
  double expected() const { return expected_; }

  double drawn(const std::vector<double>& xi) const {
    double square = value_;
    for (std::size_t a = 0; a < xi_.size(); ++a) {
      const auto i = static_cast<Eigen::Index>(a);
      square += 2 * xi[xi_[a]] * mixed_(i);
      for (std::size_t b = 0; b < xi_.size(); ++b)
        square += xi[xi_[a]] * xi[xi_[b]] * squares_(i, static_cast<Eigen::Index>(b));
    }
    return square;
  }

 private:
  double expected_ = 0, value_ = 0;
  std::vector<std::size_t> xi_;
  Eigen::VectorXd mixed_;
  Eigen::MatrixXd squares_;
};

struct Sums {
  Sum all;
  std::vector<MeanSquare> layers, causes;
  std::size_t random_numbers = 0;
};

Sums sums_of(const PartPath& path, const std::vector<PartCause>& causes, std::size_t layers) {
  Sums sums;
  std::vector<Sum> of_layer(layers), unknown(layers);
  const auto points = static_cast<double>(path.at_m.size());
  for (std::size_t c = 0; c < causes.size(); ++c) {
    const Sum cause = sum_of_cause(path, causes, c);
    const Sum unknown_cause = is_unknown(cause) ? cause : Sum{};
    sums.causes.emplace_back(cause, unknown_cause, points);
    add(cause, of_layer[causes[c].layer]);
    add(unknown_cause, unknown[causes[c].layer]);
    add(cause, sums.all);
  }
  for (std::size_t k = 0; k < layers; ++k)
    sums.layers.emplace_back(of_layer[k], unknown[k], points);
  for (const Effect& effect : sums.all.effects)
    sums.random_numbers = std::max(sums.random_numbers, effect.xi + 1);
  return sums;
}

std::vector<double> expected_squares(const std::vector<MeanSquare>& sums) {
  std::vector<double> squares;
  for (const MeanSquare& sum : sums) squares.push_back(std::max(0.0, sum.expected()));
  return squares;
}

std::vector<double> drawn_squares(const std::vector<MeanSquare>& sums,
                                  const std::vector<double>& xi) {
  std::vector<double> squares;
  for (const MeanSquare& sum : sums) squares.push_back(std::max(0.0, sum.drawn(xi)));
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

void find_shares(const std::vector<MeanSquare>& sums, const Sums& all, const PartTrials& trials,
                 std::vector<PartShare>& shares) {
  const std::vector<double> expected = expected_squares(sums);
  const double whole = sum_of(expected);
  for (const double square : expected)
    shares.push_back({std::sqrt(square), 0, whole > 0 ? square / whole : 0, 0});
  std::vector<std::vector<double>> off_share(shares.size()), off_rms(shares.size());
  for (std::size_t trial = 0; trial < trials.shares; ++trial) {
    const std::vector<double> squares =
        drawn_squares(sums, drawn(trials.seed, trial, all.random_numbers));
    const double sum = sum_of(squares);
    for (std::size_t k = 0; k < shares.size(); ++k) {
      off_share[k].push_back(std::abs((sum > 0 ? squares[k] / sum : 0) - shares[k].share));
      off_rms[k].push_back(std::abs(std::sqrt(squares[k]) - shares[k].rms_m));
    }
  }
  for (std::size_t k = 0; k < shares.size(); ++k) {
    shares[k].U_share = quantile_95(std::move(off_share[k]));
    shares[k].U_rms_m = quantile_95(std::move(off_rms[k]));
  }
}

// Returns the magnitude of the error at every `every`-th point. Without random numbers it is the
// magnitude of the value.
std::vector<double> sizes(const PartPath& path, const Sum& all, const std::vector<double>& xi,
                          std::size_t every) {
  const std::size_t width = path.normal.empty() ? 3 : 1;
  std::vector<double> found;
  for (std::size_t k = 0; k < path.at_m.size(); k += every) {
    double square = 0;
    for (std::size_t i = k * width; i < (k + 1) * width; ++i) {
      double error = all.value[i];
      if (!xi.empty())
        for (const Effect& effect : all.effects) error += xi[effect.xi] * effect.u[i];
      square += error * error;
    }
    found.push_back(std::sqrt(square));
  }
  return found;
}

// Returns the index of the point with the largest expected square of the error. The values of a
// budget are 0, so the error without random numbers has no largest point.
std::size_t worst_point(const Sum& all, const std::vector<double>& errors_m, std::size_t width) {
  std::size_t worst = 0;
  double most = -1;
  for (std::size_t k = 0; k < errors_m.size(); ++k) {
    double square = errors_m[k] * errors_m[k];
    for (const Effect& effect : all.effects)
      for (std::size_t i = k * width; i < (k + 1) * width; ++i) square += std::pow(effect.u[i], 2);
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
  const Sums sums = sums_of(path, causes, layers);
  find_shares(sums.layers, sums, trials, result.layers);
  find_shares(sums.causes, sums, trials, result.causes);
  const std::vector<double> found = sizes(path, sums.all, {}, 1);
  result.worst = worst_point(sums.all, found, path.normal.empty() ? 3 : 1);
  result.max_m = *std::max_element(found.begin(), found.end());
  result.p95_m = quantile_95(found);
  // The trials may use fewer points than the estimate. So they are compared with the error at the
  // same points without random numbers.
  const std::size_t every = std::max<std::size_t>(1, path.at_m.size() / kPointsPerTrial);
  const std::vector<double> thinned = sizes(path, sums.all, {}, every);
  const double p95_m = quantile_95(thinned),
               max_m = *std::max_element(thinned.begin(), thinned.end());
  std::vector<double> drawn_p95, drawn_max;
  for (std::size_t trial = 0; trial < trials.errors; ++trial) {
    const std::vector<double> drawn_sizes =
        sizes(path, sums.all, drawn(trials.seed, trial, sums.random_numbers), every);
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
