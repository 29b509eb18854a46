#include "algo/plausibility/probe/probe_step.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace mdof::algo {
namespace {

constexpr std::size_t kLanes = 8;
constexpr double kAbove = 8;      // times the changes in the rows before and after
constexpr double kOthers = 0.25;  // largest change of another probe, as share of the step
// Smallest remaining change after some scans, as share of the step.
constexpr double kLeastLastingShare = 0.6;
constexpr std::size_t kSettled = 3;  // rows of the medians before and after the step
constexpr double kAxis_m = 2e-6;     // noise of an encoder

// Returns the largest |x[i] - x[i-1]| for i = first ... last - 1. Eight parallel maxima allow
// vector instructions.
double largest_change(const double* x, std::size_t first, std::size_t last) {
  std::array<double, kLanes> most{};
  std::size_t i = first;
  for (; i + kLanes <= last; i += kLanes) {
    for (std::size_t k = 0; k < kLanes; ++k) {
      const double change = std::abs(x[i + k] - x[i + k - 1]);
      most[k] = change > most[k] ? change : most[k];
    }
  }
  for (; i < last; ++i) most[0] = std::max(most[0], std::abs(x[i] - x[i - 1]));
  return *std::max_element(most.begin(), most.end());
}

// Returns the largest change in the rows of begin ... end without first ... last and the rows next
// to this range.
double around(const double* x, std::size_t begin, std::size_t first, std::size_t last,
              std::size_t end) {
  return std::max(largest_change(x, begin + 1, std::max(begin + 1, first - 1)),
                  largest_change(x, std::min(end, last + 2), end));
}

double middle(const double* x) {
  std::array<double, kSettled> rows;
  std::copy(x, x + kSettled, rows.begin());
  std::sort(rows.begin(), rows.end());
  return rows[kSettled / 2];
}

// Returns the change of the reading from the scans before `row` to the scans after it; 0 if these
// rows do not exist.
double lasting_change(const double* x, std::size_t begin, std::size_t row, std::size_t end) {
  if (row < begin + kSettled + 1 || row + kSettled + 1 > end) return 0;
  return middle(x + row + 1) - middle(x + row - kSettled - 1);
}

bool good(const FrameBlock& frames, std::size_t probe, std::size_t begin, std::size_t end) {
  const auto& quality = frames.probe_quality[probe];
  return quality.empty() || std::all_of(quality.begin() + static_cast<std::ptrdiff_t>(begin),
                                        quality.begin() + static_cast<std::ptrdiff_t>(end), usable);
}

}  // namespace

std::vector<ProbeStep> find_steps(const FrameBlock& frames, std::size_t begin, std::size_t first,
                                  std::size_t last, std::size_t end) {
  std::vector<ProbeStep> found;
  if (first < begin + 2 || last + 2 > end) return found;
  const std::size_t probes = frames.probe_m.size();
  std::vector<double> most(probes);
  for (std::size_t k = 0; k < probes; ++k)
    most[k] = largest_change(frames.probe_m[k].data(), first, last);
  for (std::size_t k = 0; k < probes; ++k) {
    const double* const x = frames.probe_m[k].data();
    const bool alone = std::none_of(most.begin(), most.end(), [&](const double& other) {
      return &other != &most[k] && other >= kOthers * most[k];
    });
    if (!(most[k] > 0) || !alone || !good(frames, k, begin, end)) continue;
    if (most[k] < kAbove * around(x, begin, first, last, end)) continue;
    const double* const axis = frames.encoder_m.data();
    if (largest_change(axis, first, last) > 2 * around(axis, begin, first, last, end) + kAxis_m)
      continue;
    std::size_t row = first;
    while (row < last && std::abs(x[row] - x[row - 1]) < most[k]) ++row;
    const double size_m = row < last ? lasting_change(x, begin, row, end) : 0;
    if (std::abs(size_m) >= kLeastLastingShare * most[k] && size_m * (x[row] - x[row - 1]) > 0)
      found.push_back({k, row, size_m});
  }
  return found;
}

}  // namespace mdof::algo
