#include "algo/part/part_error.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "algo/part/measured_square.h"
#include "algo/part/true_scale.h"
#include "schema/base/random.h"

namespace mdof::algo {
namespace {

constexpr std::size_t kPointsPerTrial =
    1000;  // approximate number of points of the path in each trial

constexpr double kLeastRest = 1e-12;  // relative to the mean square of the value; less is rounding

// Normally distributed random numbers with variance 1, one for each quantity: the errors of the
// measured values or the unknown errors (`xi`), and the errors that turn the measured value in
// another direction (`turn`, only for mean squares).
struct Trial {
  std::vector<double> xi, turn;
};

Trial drawn(std::uint64_t seed, std::size_t trial, std::size_t count) {
  Trial found;
  for (std::size_t q = 0; q < count; ++q) {
    const Philox words =
        philox({{static_cast<std::uint32_t>(trial), 0, static_cast<std::uint32_t>(q), 0}}, seed);
    found.xi.push_back(gaussian(uniform(words[0], words[1])));
    found.turn.push_back(gaussian(uniform(words[2], words[3])));
  }
  return found;
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

// The error of one cause, of the causes of a layer, or of all causes. Each list of effects has one
// effect for each xi.
struct Sum {
  std::vector<double> value;
  std::vector<Effect> measured;  // u of values that were measured
  std::vector<Effect> unknown;   // u of causes whose value is unknown: the error itself
};

void add(const std::vector<double>& from, std::vector<double>& to) {
  if (to.empty()) to.resize(from.size());
  for (std::size_t k = 0; k < from.size(); ++k) to[k] += from[k];
}

void add(const std::vector<Effect>& from, std::vector<Effect>& to) {
  for (const Effect& effect : from) {
    const auto same =
        std::find_if(to.begin(), to.end(), [&](const Effect& e) { return e.xi == effect.xi; });
    if (same == to.end())
      to.push_back(effect);
    else
      add(effect.u, same->u);
  }
}

void add(const Sum& from, Sum& to) {
  add(from.value, to.value);
  add(from.measured, to.measured);
  add(from.unknown, to.unknown);
}

// Cause c has the random number c. The common parts have the numbers after the causes.
Sum sum_of_cause(const PartPath& path, const std::vector<PartCause>& causes, std::size_t c) {
  Sum sum{seen(path, causes[c].value_m), {}, {}};
  const bool is_unknown =
      std::all_of(sum.value.begin(), sum.value.end(), [](double x) { return x == 0; });
  std::vector<Effect>& effects = is_unknown ? sum.unknown : sum.measured;
  effects.push_back({c, seen(path, causes[c].u_m)});
  for (const CommonPart& part : causes[c].common)
    effects.push_back({causes.size() + part.number, seen(path, part.u_m)});
  return sum;
}

// The mean square error of a sum over the points.
class MeanSquare {
 public:
  MeanSquare(const Sum& sum, double points) {
    std::vector<const std::vector<double>*> fields{&sum.value};
    for (const auto* effects : {&sum.measured, &sum.unknown})
      for (const Effect& effect : *effects) {
        fields.push_back(&effect.u);
        xi_.push_back(effect.xi);
      }
    const auto n = static_cast<Eigen::Index>(fields.size());
    products_ = Eigen::MatrixXd(n, n);
    for (Eigen::Index a = 0; a < n; ++a)
      for (Eigen::Index b = 0; b <= a; ++b)
        products_(a, b) = products_(b, a) = product(*fields[static_cast<std::size_t>(a)],
                                                    *fields[static_cast<std::size_t>(b)], points);
    const auto measured = static_cast<Eigen::Index>(sum.measured.size());
    errors_ = MeasuredSquare(products_.block(1, 1, measured, measured),
                             products_.col(0).segment(1, measured));
    rest_ = Eigen::VectorXd::Zero(n);
    rest_(0) = 1;
    rest_.segment(1, measured) = -errors_.value();
    if (rest_.dot(products_ * rest_) <= kLeastRest * products_(0, 0)) rest_.setZero();
  }

  // Mean square of the measured values.
  double of_value() const { return products_(0, 0); }

  // The trials have the median of_value(), except for random differences.
  bool has_one_direction() const { return errors_.directions() <= 1; }

  // Expected mean square of the unknown causes.
  double expected_of_unknown() const {
    return products_.diagonal().tail(products_.rows() - 1 - errors_.effects()).sum();
  }

  struct Drawn {
    double measured = 0, all = 0;  // without and with the unknown causes
  };

  // One trial for the true mean square (README.md).
  Drawn drawn(const Trial& trial) const {
    Eigen::VectorXd xi(std::ssize(xi_)), turn(std::ssize(xi_));
    for (std::size_t k = 0; k < xi_.size(); ++k) {
      xi(static_cast<Eigen::Index>(k)) = trial.xi[xi_[k]];
      turn(static_cast<Eigen::Index>(k)) = trial.turn[xi_[k]];
    }
    const Eigen::Index measured = errors_.effects();
    Eigen::VectorXd truth = rest_;
    truth.segment(1, measured) += errors_.drawn_truth(xi.head(measured), turn.head(measured));
    const auto square = [&] { return std::max(0.0, truth.dot(products_ * truth)); };
    Drawn found{square(), 0};
    truth.tail(xi.size() - measured) = xi.tail(xi.size() - measured);
    found.all = square();
    return found;
  }

 private:
  std::vector<std::size_t> xi_;  // number Effect::xi of each effect: measured, then unknown
  Eigen::MatrixXd products_;     // mean products of the value and the effects
  MeasuredSquare errors_;
  Eigen::VectorXd rest_;  // the part of the value that no measured effect changes
};

struct Sums {
  Sum all;
  std::vector<MeanSquare> layers, causes;
  std::size_t random_numbers = 0;
};

Sums sums_of(const PartPath& path, const std::vector<PartCause>& causes, std::size_t layers) {
  Sums sums;
  std::vector<Sum> of_layer(layers);
  const auto points = static_cast<double>(path.at_m.size());
  for (std::size_t c = 0; c < causes.size(); ++c) {
    const Sum cause = sum_of_cause(path, causes, c);
    sums.causes.emplace_back(cause, points);
    add(cause, of_layer[causes[c].layer]);
    add(cause, sums.all);
  }
  for (const Sum& layer : of_layer) sums.layers.emplace_back(layer, points);
  for (const auto* effects : {&sums.all.measured, &sums.all.unknown})
    for (const Effect& effect : *effects)
      sums.random_numbers = std::max(sums.random_numbers, effect.xi + 1);
  return sums;
}

// NaN: all squares are 0.
std::vector<double> shares_of(const std::vector<double>& squares) {
  const double sum = std::accumulate(squares.begin(), squares.end(), 0.0);
  std::vector<double> shares;
  for (const double square : squares) shares.push_back(sum > 0 ? square / sum : std::nan(""));
  return shares;
}

// The trials of one layer or cause.
struct DrawnShare {
  std::vector<double> measured_squares, rms_m, shares;
  double sum_of_squares = 0;
};

std::vector<DrawnShare> drawn_shares(const std::vector<MeanSquare>& sums, const Sums& all,
                                     const PartTrials& trials) {
  std::vector<DrawnShare> found(sums.size());
  for (std::size_t trial = 0; trial < trials.shares; ++trial) {
    const Trial random = drawn(trials.seed, trial, all.random_numbers);
    std::vector<double> squares;
    for (std::size_t k = 0; k < sums.size(); ++k) {
      const MeanSquare::Drawn square = sums[k].drawn(random);
      squares.push_back(square.all);
      found[k].measured_squares.push_back(square.measured);
      found[k].rms_m.push_back(std::sqrt(square.all));
      found[k].sum_of_squares += square.all;
    }
    const std::vector<double> shares = shares_of(squares);
    for (std::size_t k = 0; k < sums.size(); ++k)
      if (!std::isnan(shares[k])) found[k].shares.push_back(shares[k]);
  }
  return found;
}

// Without trials, the stated squares are those of the values, and the intervals have the length 0.
std::vector<PartShare> find_shares(const std::vector<MeanSquare>& sums, const Sums& all,
                                   const PartTrials& trials) {
  std::vector<DrawnShare> drawn = drawn_shares(sums, all, trials);
  std::vector<double> squares, sums_of_squares;
  for (std::size_t k = 0; k < sums.size(); ++k) {
    std::vector<double>& measured = drawn[k].measured_squares;
    squares.push_back(sums[k].expected_of_unknown() +
                      (measured.empty() || sums[k].has_one_direction() ? sums[k].of_value()
                                                                       : median_of(measured)));
    sums_of_squares.push_back(drawn[k].sum_of_squares);
  }
  // If all medians are 0, the means of the trials determine the shares.
  std::vector<double> shares = shares_of(squares);
  if (std::all_of(squares.begin(), squares.end(), [](double square) { return square == 0; }))
    shares = shares_of(sums_of_squares);
  std::vector<PartShare> found;
  for (std::size_t k = 0; k < sums.size(); ++k) {
    const double rms_m = std::sqrt(squares[k]);
    found.push_back({rms_m, {rms_m, rms_m}, shares[k], {shares[k], shares[k]}});
    if (!drawn[k].rms_m.empty())
      found[k].rms_interval_m = containing(rms_m, interval_of(drawn[k].rms_m));
    if (!drawn[k].shares.empty())
      found[k].share_interval = containing(shares[k], interval_of(drawn[k].shares));
  }
  return found;
}

// Every `every`-th point of a list with `width` numbers for each point.
std::vector<double> thinned(const std::vector<double>& list, std::size_t width, std::size_t every) {
  std::vector<double> found;
  for (std::size_t k = 0; k < list.size(); k += every * width)
    for (std::size_t i = 0; i < width; ++i) found.push_back(list[k + i]);
  return found;
}

std::vector<Effect> thinned(std::vector<Effect> effects, std::size_t width, std::size_t every) {
  for (Effect& effect : effects) effect.u = thinned(effect.u, width, every);
  return effects;
}

// The sum of the effects, as a list of `size` numbers.
std::vector<double> drawn_field(const std::vector<Effect>& effects, const std::vector<double>& xi,
                                std::size_t size) {
  std::vector<double> field(size, 0.0);
  for (const Effect& effect : effects)
    for (std::size_t i = 0; i < size; ++i) field[i] += xi[effect.xi] * effect.u[i];
  return field;
}

// The magnitude at each point of scale * value + error.
std::vector<double> sizes(const std::vector<double>& value, double scale,
                          const std::vector<double>& error, std::size_t width) {
  std::vector<double> found;
  found.reserve(value.size() / width);
  for (std::size_t k = 0; k < value.size(); k += width) {
    double square = 0;
    for (std::size_t i = k; i < k + width; ++i) {
      const double sum = scale * value[i] + error[i];
      square += sum * sum;
    }
    found.push_back(std::sqrt(square));
  }
  return found;
}

// The number of points whose error does not exceed p95. The largest error is exceeded by no point.
std::size_t points_within_95(std::size_t points) {
  return std::min(static_cast<std::size_t>(0.95 * static_cast<double>(points)) + 1, points);
}

std::size_t all_points(std::size_t points) {
  return points;
}

// The error that `within` points do not exceed.
double figure_of(std::vector<double> sizes, std::size_t within) {
  const auto k = sizes.begin() + static_cast<std::ptrdiff_t>(within) - 1;
  std::nth_element(sizes.begin(), k, sizes.end());
  return *k;
}

// Returns the index of the point with the largest expected square of the error. The values of a
// budget are 0, so the error without random numbers has no largest point.
std::size_t worst_point(const Sum& all, std::size_t width) {
  std::size_t worst = 0;
  double most = -1;
  for (std::size_t k = 0; k < all.value.size(); k += width) {
    double square = 0;
    for (std::size_t i = k; i < k + width; ++i) {
      square += all.value[i] * all.value[i];
      for (const auto* effects : {&all.measured, &all.unknown})
        for (const Effect& effect : *effects) square += effect.u[i] * effect.u[i];
    }
    if (square <= most) continue;
    most = square;
    worst = k / width;
  }
  return worst;
}

bool has_u(const std::vector<Effect>& effects) {
  return std::any_of(effects.begin(), effects.end(), [](const Effect& effect) {
    return std::any_of(effect.u.begin(), effect.u.end(), [](double u) { return u != 0; });
  });
}

// The median and the interval of the error that a share of the points does not exceed (README.md).
// `within`: the number of these points among a number of points. The trials may use fewer points
// than the path; they are compared with the figure of the values at the same points.
void find_figure(const Sums& sums, std::size_t (*within)(std::size_t points),
                 const PartTrials& trials, std::size_t width, std::size_t every, double& estimate_m,
                 Interval& interval_m) {
  const auto figure = [&](const std::vector<double>& value, double scale,
                          const std::vector<double>& error) {
    return figure_of(sizes(value, scale, error, width), within(value.size() / width));
  };
  const double whole_m = figure(sums.all.value, 0, sums.all.value);
  estimate_m = whole_m;
  interval_m = {whole_m, whole_m};
  // Without u, trials would give an interval of the width of the rounding errors.
  if (trials.errors == 0 || !(has_u(sums.all.measured) || has_u(sums.all.unknown))) return;
  const std::vector<double> value = thinned(sums.all.value, width, every);
  const std::vector<Effect> measured = thinned(sums.all.measured, width, every),
                            unknown = thinned(sums.all.unknown, width, every);
  const double value_m = figure(value, 0, value);
  std::vector<double> propagated, noise_alone, medians, lows;
  std::vector<ScaleRange> ranges;
  std::vector<std::vector<double>> unknown_errors;
  for (std::size_t trial = 0; trial < trials.errors; ++trial) {
    const Trial random = drawn(trials.seed, trial, sums.random_numbers);
    std::vector<double> error = drawn_field(measured, random.xi, value.size());
    noise_alone.push_back(figure(value, 0, error));
    ranges.push_back(possible_scales(value, error, width, within(value.size() / width), value_m));
    unknown_errors.push_back(drawn_field(unknown, random.xi, value.size()));
    medians.push_back(figure(value, ranges.back().high, unknown_errors.back()));
    add(unknown_errors.back(), error);
    propagated.push_back(figure(value, 1, error));
  }
  // Random true errors can be above the upper end, also where the measured errors are small.
  const double always_m = has_u(unknown) ? 0 : interval_of(noise_alone).high;
  const std::vector<double> scales = drawn_scales(ranges);
  for (std::size_t k = 0; k < scales.size(); ++k)
    lows.push_back(figure(value, lower_scale(scales, k, value_m, always_m), unknown_errors[k]));
  const double rest_m = whole_m - value_m;  // contribution of the points that the trials leave out
  const double low_m = interval_of(lows).low;
  estimate_m = std::max(0.0, rest_m + median_of(medians));
  interval_m = containing(estimate_m, {low_m > 0 ? std::max(0.0, rest_m + low_m) : 0,
                                       rest_m + interval_of(propagated).high});
}

}  // namespace

PartError part_error(const PartPath& path, const std::vector<PartCause>& causes, std::size_t layers,
                     const PartTrials& trials) {
  PartError result;
  const Sums sums = sums_of(path, causes, layers);
  result.layers = find_shares(sums.layers, sums, trials);
  result.causes = find_shares(sums.causes, sums, trials);
  const std::size_t width = path.normal.empty() ? 3 : 1,
                    every = std::max<std::size_t>(1, path.at_m.size() / kPointsPerTrial);
  result.worst = worst_point(sums.all, width);
  find_figure(sums, points_within_95, trials, width, every, result.p95_m, result.p95_interval_m);
  find_figure(sums, all_points, trials, width, every, result.max_m, result.max_interval_m);
  // Each is a median of its own. So the median of the largest error can be the smallest of them.
  const bool has_stated_rms = layers == 1 && !has_u(sums.all.unknown);
  result.max_m =
      std::max({result.max_m, result.p95_m, has_stated_rms ? result.layers[0].rms_m : 0});
  result.max_interval_m = containing(result.max_m, result.max_interval_m);
  return result;
}

}  // namespace mdof::algo
