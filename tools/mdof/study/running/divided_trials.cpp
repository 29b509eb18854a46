#include "tools/mdof/study/running/divided_trials.h"

#include <algorithm>
#include <limits>

#include "tools/mdof/study/running/workers.h"

namespace mdof::tools {

void DividedTrials::run(std::uint64_t first, std::uint64_t step, std::size_t n,
                        std::span<double* const> out) const {
  constexpr std::size_t kPiece = 4;
  const std::size_t pieces = (n + kPiece - 1) / kPiece;
  for (double* const values : out)
    std::fill(values, values + n, std::numeric_limits<double>::quiet_NaN());
  const auto piece = [&](unsigned, std::size_t i) {
    const std::size_t begin = i * kPiece, count = std::min(kPiece, n - begin);
    std::vector<double*> part(out.begin(), out.end());
    for (double*& values : part) values += begin;
    experiment_.run(first + begin * step, step, count, part);
    trials_run_ += count;
  };
  if (!go_on_() || in_parallel(threads_, pieces, piece, go_on_) < pieces) is_interrupted_ = true;
}

}  // namespace mdof::tools
