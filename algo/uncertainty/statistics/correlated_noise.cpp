#include "algo/uncertainty/statistics/correlated_noise.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <utility>

#include "algo/sensitivity/plan/functions.h"

namespace mdof::algo {
namespace {

constexpr double kWhiteBefore = 0.97;  // probability of white noise before the residuals are known

bool one_after_the_other(const std::vector<NoisyVisit>& visits) {
  return std::adjacent_find(visits.begin(), visits.end(), [](const auto& a, const auto& b) {
           return !(a.time_s < b.time_s);
         }) == visits.end();
}

// Calls `use(first, end)` for each pass, which has the visits from first to end - 1.
template <class Use>
void for_each_pass(const std::vector<NoisyVisit>& visits, Use use) {
  for (std::size_t first = 0, end = 0; first < visits.size(); first = end) {
    while (end < visits.size() && visits[end].pass == visits[first].pass) ++end;
    use(first, end);
  }
}

}  // namespace

CorrelatedNoise::CorrelatedNoise(std::vector<NoisyVisit> visits, double freedom)
    : visits_(std::move(visits)), freedom_(freedom), models_(1) {
  const double white = fit(models_.front());
  if (!(models_.front().variance > 0) || !one_after_the_other(visits_)) return;
  std::vector<double> time_s, log_probability = {white + natural_log(kWhiteBefore)};
  for (const NoisyVisit& visit : visits_) time_s.push_back(visit.time_s);
  for (const SlowNoise& noise : slow_noises(time_s))
    if (noise.share > 0) models_.push_back({noise});
  const double before = (1 - kWhiteBefore) / static_cast<double>(models_.size() - 1);
  for (std::size_t m = 1; m < models_.size(); ++m)
    log_probability.push_back(fit(models_[m]) + natural_log(before));
  const double most = *std::max_element(log_probability.begin(), log_probability.end());
  double sum = 0;
  for (std::size_t m = 0; m < models_.size(); ++m)
    sum += models_[m].probability = exponential(log_probability[m] - most);
  for (Model& model : models_) model.probability /= sum;
}

// Returns the logarithm of the restricted likelihood, except for a constant. The residuals have
// fewer degrees of freedom than their number, because the means of the targets were subtracted.
// Therefore the logarithm of the determinants is multiplied by freedom_ / counted.
double CorrelatedNoise::fit(Model& model) const {
  double square = 0, log_determinants = 0;
  std::size_t counted = 0;
  for_each_pass(visits_, [&](std::size_t first, std::size_t end) {
    std::vector<double> time_s;
    Eigen::MatrixXd rows(static_cast<Eigen::Index>(end - first), 2);
    Eigen::Index n = 0;
    for (std::size_t i = first; i < end; ++i) {
      if (std::isnan(visits_[i].residual)) continue;
      time_s.push_back(visits_[i].time_s);
      rows.row(n++) << visits_[i].residual, 1;
    }
    if (n < 2) return;
    double log_variances = 0;
    const Eigen::MatrixXd white = whitened(time_s, model.noise, rows.topRows(n), log_variances);
    const double ones = white.col(1).squaredNorm(), level = white.col(0).dot(white.col(1));
    square += white.col(0).squaredNorm() - level * level / ones;
    log_determinants += log_variances + natural_log(ones);
    counted += static_cast<std::size_t>(n) - 1;
  });
  model.variance = square / freedom_;
  if (!(square > 0)) return 0;
  const double part = freedom_ / static_cast<double>(counted);
  return -(part * log_determinants + freedom_ * natural_log(square)) / 2;
}

double CorrelatedNoise::variance(const Model& model, std::span<const double> by_visit) const {
  // `before`: sum over the earlier visits of by_visit times the correlation with visit i.
  double sum = 0, before = 0;
  for (std::size_t i = 0; i < visits_.size(); ++i) {
    if (i > 0 && model.noise.share > 0)
      before =
          exponential((visits_[i - 1].time_s - visits_[i].time_s) / model.noise.correlation_s) *
          (before + by_visit[i - 1]);
    sum += by_visit[i] * (by_visit[i] + 2 * model.noise.share * before);
  }
  return model.variance * sum;
}

CorrelatedNoise::Widened CorrelatedNoise::of(std::span<const double> by_target) const {
  std::vector<double> by_visit;
  for (const NoisyVisit& visit : visits_)
    by_visit.push_back(by_target[visit.target] * visit.weight);
  for_each_pass(visits_, [&](std::size_t first, std::size_t end) {
    double level = 0;
    for (std::size_t i = first; i < end; ++i)
      level += by_visit[i] / static_cast<double>(end - first);
    for (std::size_t i = first; i < end; ++i) by_visit[i] -= level;
  });
  const double white = variance(models_.front(), by_visit);
  if (!(white > 0) || models_.size() == 1) return {1, freedom_};
  double mean = 0, mean_square = 0;
  for (const Model& model : models_) {
    const double v = variance(model, by_visit);
    mean += model.probability * v;
    mean_square += model.probability * v * v * (1 + 2 / freedom_);
  }
  // The relative variance of a variance with ν degrees of freedom is 2/ν.
  return {mean / white, 2 * mean * mean / (mean_square - mean * mean)};
}

}  // namespace mdof::algo
