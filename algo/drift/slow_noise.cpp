#include "algo/drift/slow_noise.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "algo/sensitivity/plan/functions.h"

namespace mdof::algo {
namespace {

constexpr double kLongest = 8;  // longest τ, in lengths of the log: in practice a random walk

}  // namespace

Eigen::MatrixXd whitened(const std::vector<double>& time_s, const SlowNoise& noise,
                         const Eigen::MatrixXd& rows, double& log_variances) {
  Eigen::MatrixXd white(rows.rows(), rows.cols());
  Eigen::RowVectorXd expected = Eigen::RowVectorXd::Zero(rows.cols());
  double variance = noise.share;  // variance of the slow noise if the rows before are known
  log_variances = 0;
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const double all = variance + 1 - noise.share, gain = variance / all;
    white.row(i) = (rows.row(i) - expected) / std::sqrt(all);
    log_variances += natural_log(all);
    if (noise.share == 0 || i + 1 == rows.rows()) continue;
    const auto now = static_cast<std::size_t>(i);
    const double kept = exponential((time_s[now] - time_s[now + 1]) / noise.correlation_s);
    expected = kept * (expected + gain * (rows.row(i) - expected)).eval();
    variance = kept * kept * variance * (1 - gain) + noise.share * (1 - kept * kept);
  }
  return white;
}

std::vector<SlowNoise> slow_noises(const std::vector<double>& time_s) {
  std::vector<SlowNoise> all = {{}};
  const double length_s = time_s.back() - time_s.front();
  const double apart_s = length_s / static_cast<double>(time_s.size() - 1);
  for (double steps = 1; steps * apart_s <= kLongest * length_s; steps *= 2)
    for (const double by_white : {0.25, 1.0, 4.0, 16.0, 256.0}) {
      const double ratio = by_white * std::max(1.0, steps / 4);
      all.push_back({steps * apart_s, ratio / (1 + ratio)});
    }
  return all;
}

Eigen::VectorXd WeighedFit::shapes(const Eigen::VectorXd& polynomials) const {
  return root.transpose().triangularView<Eigen::Lower>().solve(polynomials);
}

double WeighedFit::minus_two_log_likelihood(Eigen::Index series, double freedom,
                                            double least_square) const {
  return log_determinants +
         freedom * natural_log(std::max(left(series, series) / freedom, least_square));
}

WeighedFit weighed_fit(const DriftRows& rows, const SlowNoise& noise) {
  const Eigen::Index n = rows.polynomials.rows(), orders = rows.polynomials.cols();
  const auto places = static_cast<Eigen::Index>(rows.places), known = places + orders;
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(n, known + rows.y.cols());
  for (Eigen::Index i = 0; i < n; ++i)
    all(i, static_cast<Eigen::Index>(rows.place[static_cast<std::size_t>(i)])) = 1;
  all.middleCols(places, orders) = rows.polynomials;
  all.rightCols(rows.y.cols()) = rows.y;
  WeighedFit fit;
  fit.noise = noise;
  const Eigen::MatrixXd white = whitened(rows.time_s, noise, all, fit.log_determinants);
  const Eigen::MatrixXd products = white.transpose() * white;
  const Eigen::LLT<Eigen::MatrixXd> root(products.topLeftCorner(known, known));
  if (root.info() != Eigen::Success) return fit;
  const Eigen::MatrixXd lower = root.matrixL();
  const Eigen::MatrixXd by_column =
      root.matrixL().solve(products.topRightCorner(known, rows.y.cols()));
  for (Eigen::Index i = 0; i < known; ++i) fit.log_determinants += 2 * natural_log(lower(i, i));
  fit.scores = by_column.bottomRows(orders);
  fit.root = lower.bottomRightCorner(orders, orders).transpose();
  fit.left =
      products.bottomRightCorner(rows.y.cols(), rows.y.cols()) - by_column.transpose() * by_column;
  fit.solved = true;
  return fit;
}

}  // namespace mdof::algo
