// Result of a sensitivity study, which is printed, stored and plotted. Values are in the unit at
// the end of the key of their output ("EAX_urad", "EYX_um").
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace mdof {

struct CoverageInterval {
  double low = 0, high = 0;
};

struct Quantile {
  double p = 0, value = 0;
};

// A histogram for plots: counts[i] trials in [from + i width, from + (i+1) width).
struct Histogram {
  double from = 0, width = 0;
  std::vector<std::uint64_t> counts;
  std::uint64_t below = 0, above = 0;
};

// Statistics of one output over n trials.
struct OutputSummary {
  std::string key;
  std::uint64_t n = 0;         // trials solved
  std::uint64_t unsolved = 0;  // trials without a solution: not included in any figure
  double mean = 0, mean_se = 0, sd = 0, sd_se = 0, min = 0, max = 0;
  std::vector<Quantile> quantiles;  // ascending p
  double coverage = 0.95;
  CoverageInterval symmetric;  // probabilistically symmetric, JCGM 101 §7.7
  CoverageInterval shortest;   // JCGM 101 §5.3.4
  // Largest distance of a quantile or an end of an interval from the exact order statistic of the
  // same trials, which sorting all of them would give.
  double resolution = 0;
  Histogram histogram;
};

// One bin of the binned quantity.
struct StudyBin {
  double from = 0, to = 0;  // unit of StudyResult::binned_key
  std::vector<OutputSummary> outputs;
};

// Convergence of the figures of one output with the number of trials.
struct ConvergencePoint {
  std::uint64_t trials = 0;
  double mean = 0, sd = 0, low = 0, high = 0;  // low, high: symmetric interval
};
struct Convergence {
  std::string key;
  std::vector<ConvergencePoint> points;
};

// Variance-based indices (Sobol) of one output; se: standard error of each.
struct CauseIndex {
  std::string cause;
  double first = 0, first_se = 0, total = 0, total_se = 0;
};
struct OutputIndices {
  std::string key;
  std::vector<CauseIndex> causes;  // largest total first
};

// Largest tolerances for which P(|output| <= limit) >= probability.
struct AllocatedTolerance {
  std::string tolerance;     // key in the plan with its unit, "probe_position_um"
  double value = 0;          // largest value that keeps the limit
  double low = 0, high = 0;  // its sampling uncertainty, 95 %
};
struct Allocation {
  std::string output;
  double limit = 0, probability = 0;
  double reached = 0;                     // P with the tolerances of the plan
  std::vector<AllocatedTolerance> alone;  // each alone, the others as planned
  double common_factor = 0;               // factor on all allocated tolerances together
  // Pairs: for a value of the first tolerance, the largest value of the second.
  std::vector<std::vector<AllocatedTolerance>> frontier;
};

// Two fixtures compared with the same random numbers.
struct ComparedOutput {
  std::string key;
  double sd_this = 0, sd_other = 0, ratio = 0, ratio_se = 0;  // ratio = other / this
};

enum class StudyState { complete, interrupted };
const char* to_string(StudyState state);

struct StudyResult {
  std::string name;       // "simulation-1", or the plan's name
  std::string plan_toml;  // the whole plan; for a preset its options in the same form
  std::string software;   // version
  std::string started_utc;
  std::uint64_t seed = 0, trials = 0;  // done
  std::uint64_t trials_wanted = 0;
  double elapsed_s = 0;
  StudyState state = StudyState::complete;
  std::vector<OutputSummary> outputs;
  std::string binned_key;  // "travel_mm"; "" : no bins
  std::vector<StudyBin> bins;
  std::vector<Convergence> convergence;
  std::vector<OutputIndices> indices;
  std::vector<Allocation> allocations;
  std::vector<ComparedOutput> comparison;
  std::vector<std::string> warnings;
};

}  // namespace mdof
