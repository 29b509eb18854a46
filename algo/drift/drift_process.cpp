#include "algo/drift/drift_process.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "algo/linear_algebra/covariance_root.h"
#include "algo/sensitivity/plan/functions.h"
#include "schema/base/random.h"

namespace mdof::algo {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kLeastWeight = 1e-4;  // models with a smaller likelihood / maximum are left out
constexpr Eigen::Index kWaves = 48, kTerms = 1 + kWaves;
// The cosines have no slope at the ends of their interval. Therefore the interval is longer than
// the log, by this part of the log at each end.
constexpr double kMargin = 0.25;
// The logarithmic times are log(1 + t / start); times in lengths of the log. 0: the elapsed time.
constexpr std::array kStarts = {0.0, 0.1, 0.02};
constexpr std::array kCorrelations = {0.05, 0.1, 0.2, 0.4, 0.8, 1.6};  // in lengths of the log
// Standard deviations of the smooth part, and of the random walk at the end of the log, relative to
// the white noise.
constexpr std::array kSmooth = {1.0, 6.0, 36.0, 216.0};
constexpr std::array kWalks = {0.0, 1.0, 2.0, 4.0, 7.0, 12.0, 25.0, 50.0};
// Limit of the relative variance of u² between the models. The distribution over all models is
// symmetric and has one maximum, so its 95 % interval is at most 2.98 u wide on each side
// (Vysochanskij, Petunin, Theory Probab. Math. Statist. 21 (1980) 25). This is k of
// 2 / kMostDisagreement = 3.40 degrees of freedom.
constexpr double kMostDisagreement = 0.5885;
constexpr double kLeastVariance = 1e-30;

double angular_frequency(Eigen::Index wave) {
  return kPi * static_cast<double>(wave) / (1 + 2 * kMargin);
}

// Variance of the amplitude of a cosine: its spectral density times 2 / (length of the interval).
double variance_of(Eigen::Index wave, double smooth, double correlation, double walk) {
  const double w2 = angular_frequency(wave) * angular_frequency(wave);
  const double five = 5 / (correlation * correlation), sum = five + w2;
  const double matern =
      smooth * smooth * 16 / 3 * five * five * std::sqrt(five) / (sum * sum * sum);
  return (matern + walk * walk / w2) * 2 / (1 + 2 * kMargin);
}

// Converts logarithms of likelihoods to weights with the sum 1.
void normalize_weights(Eigen::Ref<Eigen::VectorXd> weights) {
  const double most = weights.maxCoeff();
  for (double& weight : weights) {
    weight = exponential(weight - most);
    if (weight < kLeastWeight) weight = 0;
  }
  weights /= weights.sum();
}

// The terms of all kinds of time: the trend, then the cosines of each kind.
Eigen::Index first_wave(std::size_t clock) {
  return 1 + static_cast<Eigen::Index>(clock) * kWaves;
}

}  // namespace

// The trend a t, the first term, has no known variance. Before the log is known, one half of the
// drifts have no smooth part, and all sizes, correlation times and kinds of time of a smooth part
// are equally likely, as are all sizes of the walk.
std::vector<DriftProcess::Model> DriftProcess::models() {
  const double no_smooth_part =
      natural_log(static_cast<double>(kStarts.size() * kCorrelations.size() * kSmooth.size()));
  std::vector<Model> all;
  const auto add = [&](std::size_t clock, double smooth, double correlation, double walk) {
    Model model{clock, Eigen::VectorXd::Zero(kTerms), 0, smooth == 0 ? no_smooth_part : 0};
    for (Eigen::Index wave = 1; wave <= kWaves; ++wave) {
      const double variance =
          std::max(variance_of(wave, smooth, correlation, walk), kLeastVariance);
      model.precision(wave) = 1 / variance;
      model.log_variances += natural_log(variance);
    }
    all.push_back(std::move(model));
  };
  for (const double walk : kWalks) {
    add(0, 0, 1, walk);
    for (std::size_t clock = 0; clock < kStarts.size(); ++clock)
      for (const double correlation : kCorrelations)
        for (const double smooth : kSmooth) add(clock, smooth, correlation, walk);
  }
  return all;
}

double DriftProcess::freedom_of_noise(const DriftDesign& design) {
  return design.visits_minus_places() - 1;
}

// `squares`: for each series the sum of the squares of the readings, minus the means of the places.
DriftProcess::Fits DriftProcess::fits_of(const std::vector<Model>& models,
                                         const std::vector<Products>& products,
                                         const Eigen::VectorXd& squares, double freedom) {
  const auto count = static_cast<Eigen::Index>(models.size()), series = squares.size();
  Fits fits{{}, Eigen::MatrixXd(count, series), Eigen::MatrixXd(count, series)};
  for (Eigen::Index m = 0; m < count; ++m) {
    const Model& model = models[static_cast<std::size_t>(m)];
    const Products& of = products[model.clock];
    const Eigen::LLT<Eigen::MatrixXd> root = normal_equations(of, model);
    fits.terms.emplace_back(root.solve(of.by_series));
    double log_determinants = model.log_variances;
    for (Eigen::Index i = 0; i < kTerms; ++i)
      log_determinants += 2 * natural_log(root.matrixLLT()(i, i));
    for (Eigen::Index k = 0; k < series; ++k) {
      const double left = squares(k) - of.by_series.col(k).dot(fits.terms.back().col(k));
      fits.noise2(m, k) = std::max(left / freedom, kLeastNoise2);
      fits.weights(m, k) =
          model.log_prior - (log_determinants + freedom * natural_log(fits.noise2(m, k))) / 2;
    }
  }
  for (Eigen::Index k = 0; k < series; ++k) normalize_weights(fits.weights.col(k));
  return fits;
}

// Returns the terms of a model among the terms of all kinds of time; the other terms are 0.
Eigen::VectorXd DriftProcess::in_all_terms(const Model& model, const Eigen::VectorXd& terms) {
  Eigen::VectorXd all = Eigen::VectorXd::Zero(first_wave(kStarts.size()));
  all(0) = terms(0);
  all.segment(first_wave(model.clock), kWaves) = terms.tail(kWaves);
  return all;
}

DriftProcess::DriftProcess(const DriftDesign& design, const Eigen::MatrixXd& y,
                           const Eigen::VectorXd& noise2)
    : begin_s_(design.begin_s()), length_s_(design.end_s() - design.begin_s()) {
  const std::vector<Products> products = products_of(design, y);
  const std::vector<Model> all = models();
  const double freedom = freedom_of_noise(design);
  const Fits fits = fits_of(all, products, design.centred(y).colwise().squaredNorm(), freedom);
  const auto series = y.cols();
  const Eigen::Index whole = first_wave(kStarts.size());
  mean_ = Eigen::MatrixXd::Zero(whole, series);
  std::vector<Eigen::MatrixXd> covariances(static_cast<std::size_t>(series),
                                           Eigen::MatrixXd::Zero(whole, whole));
  Eigen::VectorXd variance = Eigen::VectorXd::Zero(series), square = variance;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto m = static_cast<Eigen::Index>(i);
    for (Eigen::Index k = 0; k < series; ++k)
      if (fits.weights(m, k) > 0)
        mean_.col(k) += fits.weights(m, k) * in_all_terms(all[i], fits.terms[i].col(k));
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto m = static_cast<Eigen::Index>(i);
    if (!(fits.weights.row(m).maxCoeff() > 0)) continue;
    const Products& of = products[all[i].clock];
    const Eigen::MatrixXd own =
        normal_equations(of, all[i]).solve(Eigen::MatrixXd::Identity(kTerms, kTerms));
    const double of_drift = own.cwiseProduct(of.mean_square).sum();
    const Eigen::Index first = first_wave(all[i].clock);
    for (Eigen::Index k = 0; k < series; ++k) {
      if (!(fits.weights(m, k) > 0)) continue;
      Eigen::MatrixXd& to = covariances[static_cast<std::size_t>(k)];
      const double noise_of_model = std::max(fits.noise2(m, k), noise2(k));
      const double by = fits.weights(m, k) * noise_of_model, here = noise_of_model * of_drift;
      variance(k) += fits.weights(m, k) * here;
      square(k) += fits.weights(m, k) * here * here;
      to(0, 0) += by * own(0, 0);
      to.block(first, 0, kWaves, 1) += by * own.block(1, 0, kWaves, 1);
      to.block(0, first, 1, kWaves) += by * own.block(0, 1, 1, kWaves);
      to.block(first, first, kWaves, kWaves) += by * own.block(1, 1, kWaves, kWaves);
      const Eigen::VectorXd off = in_all_terms(all[i], fits.terms[i].col(k)) - mean_.col(k);
      to += fits.weights(m, k) * off * off.transpose();
    }
  }
  for (const Eigen::MatrixXd& covariance : covariances)
    roots_.push_back(covariance_root(covariance));
  freedom_ = Eigen::VectorXd::Constant(series, freedom);
  for (Eigen::Index k = 0; k < series; ++k)
    if (variance(k) > 0)
      freedom_(k) =
          1 / (1 / freedom +
               std::clamp(square(k) / (variance(k) * variance(k)) - 1, 0.0, kMostDisagreement) / 2);
}

std::vector<DriftProcess::Products> DriftProcess::products_of(const DriftDesign& design,
                                                              const Eigen::MatrixXd& y) const {
  const Eigen::MatrixXd centred = design.centred(y);
  std::vector<Products> products;
  for (std::size_t clock = 0; clock < kStarts.size(); ++clock) {
    Eigen::MatrixXd rows(y.rows(), kTerms);
    for (Eigen::Index i = 0; i < y.rows(); ++i)
      rows.row(i) =
          of_clock(clock, design.visits()[static_cast<std::size_t>(i)].time_s).transpose();
    const Eigen::MatrixXd between = design.centred(rows);
    products.push_back({between.transpose() * between, between.transpose() * centred,
                        rows.transpose() * rows / static_cast<double>(y.rows())});
  }
  return products;
}

Eigen::LLT<Eigen::MatrixXd> DriftProcess::normal_equations(const Products& products,
                                                           const Model& model) {
  Eigen::MatrixXd sum = products.terms;
  sum.diagonal() += model.precision;
  return Eigen::LLT<Eigen::MatrixXd>(sum);
}

Eigen::VectorXd DriftProcess::of_clock(std::size_t clock, double time_s) const {
  const double part = std::clamp((time_s - begin_s_) / length_s_, 0.0, 1.0);
  const double start = kStarts[clock];
  const double time =
      start == 0 ? part : natural_log(1 + part / start) / natural_log(1 + 1 / start);
  const auto turns = [](Eigen::Index wave, double t) {
    return static_cast<double>(wave) * (t + kMargin) / (2 * (1 + 2 * kMargin));
  };
  Eigen::VectorXd out(kTerms);
  out(0) = part;
  for (Eigen::Index wave = 1; wave <= kWaves; ++wave)
    out(wave) = sine_of_turns(0.25 + turns(wave, time)) - sine_of_turns(0.25 + turns(wave, 0));
  return out;
}

Eigen::VectorXd DriftProcess::terms(double time_s) const {
  Eigen::VectorXd out(first_wave(kStarts.size()));
  for (std::size_t clock = 0; clock < kStarts.size(); ++clock) {
    const Eigen::VectorXd own = of_clock(clock, time_s);
    out(0) = own(0);
    out.segment(first_wave(clock), kWaves) = own.tail(kWaves);
  }
  return out;
}

}  // namespace mdof::algo
