#include "algo/uncertainty/statistics/target_noise.h"

#include <limits>

namespace mdof::algo {

TargetNoise::TargetNoise(BlockOfDraws& draws, const Repeatability& random) : random_(random) {
  const UnitQuantity normal(std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i <= random.u.size(); ++i) drawn_.push_back(draws.next(normal));
  for_freedom_ = draws.next(normal);
  for (const auto* parts : {&random.together, &random.of_passes})
    for (const std::vector<Errors5>& part : *parts) parts_.push_back(&part);
  for (std::size_t p = 0; p < parts_.size(); ++p) together_.push_back(draws.next(normal));
}

void TargetNoise::add_to(MeanErrors& means, std::size_t trial, double factor) const {
  const double shift = factor * drawn_.back()[trial];
  for (std::size_t i = 0; i < means.targets.size(); ++i)
    for (std::size_t k = 0; k < kErrorCount; ++k)
      means.targets[i].named[k] +=
          factor * drawn_[i][trial] * random_.u[i][k] + shift * random_.u_shift[k];
  for (std::size_t p = 0; p < together_.size(); ++p)
    for (std::size_t i = 0; i < means.targets.size(); ++i)
      for (std::size_t k = 0; k < kErrorCount; ++k)
        means.targets[i].named[k] += factor * together_[p][trial] * (*parts_[p])[i][k];
}

double TargetNoise::student(std::size_t trial, double freedom) const {
  return student_factor(for_freedom_[trial], freedom);
}

}  // namespace mdof::algo
